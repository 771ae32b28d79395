// SPDX-License-Identifier: MIT
#include "mir/mpi/rank_peers.hpp"

#include "mir/core/error.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace mir::mpi {
namespace {

constexpr int tag_of_size = 1;
constexpr int tag_of_part = 2;
/// MPI counts bytes by int.
constexpr std::size_t most_bytes = std::size_t{1} << 30;

void check(int code, const char* what) {
    if (code == MPI_SUCCESS) return;
    std::string reason(MPI_MAX_ERROR_STRING, '\0');
    int length = 0;
    if (MPI_Error_string(code, reason.data(), &length) != MPI_SUCCESS) length = 0;
    reason.resize(static_cast<std::size_t>(length));
    throw Error(ErrorCode::device, std::string(what) + " (" + reason +
                                       "); see to it that all ranks run and reach each other");
}

void check_mpi() {
    int begun = 0;
    int ended = 0;
    check(MPI_Initialized(&begun), "MPI cannot be asked whether it has begun");
    check(MPI_Finalized(&ended), "MPI cannot be asked whether it has ended");
    expects(begun != 0 && ended == 0,
            "ranks were to render before MPI began, or behind its end (the library does neither); "
            "call MPI_Init_thread() before and MPI_Finalize() after");
    int threads = MPI_THREAD_SINGLE;
    check(MPI_Query_thread(&threads), "MPI cannot be asked for threads");
    expects(threads >= MPI_THREAD_FUNNELED,
            "MPI was begun for one thread alone (renders have many); call MPI_Init_thread() with "
            "MPI_THREAD_FUNNELED");
}

/// A copy for messages of our own. A rank that comes early sleeps: MPI's own waiting would keep its
/// core busy.
MPI_Comm copy_of(MPI_Comm ranks) {
    check_mpi();
    constexpr const char* what = "the ranks have no communicator that can be copied";
    MPI_Comm copy = MPI_COMM_NULL;
    MPI_Request all_are_there = MPI_REQUEST_NULL;
    check(MPI_Comm_idup(ranks, &copy, &all_are_there), what);
    int done = 0;
    while (check(MPI_Test(&all_are_there, &done, MPI_STATUS_IGNORE), what), done == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return copy;
}

/// Gives MPI time for messages on their way; true when they are out.
bool are_sent(std::vector<MPI_Request>& parts) {
    int sent = 0;
    check(MPI_Testall(static_cast<int>(parts.size()), parts.data(), &sent, MPI_STATUSES_IGNORE),
          "a rank cannot be told");
    return sent != 0;
}

}  // namespace

RankPeers::RankPeers(MPI_Comm ranks) : ranks_(copy_of(ranks)) {
    int rank = 0;
    int count = 1;
    MPI_Comm_set_errhandler(ranks_, MPI_ERRORS_RETURN);
    check(MPI_Comm_rank(ranks_, &rank), "a rank has no number");
    check(MPI_Comm_size(ranks_, &count), "the ranks cannot be counted");
    rank_ = static_cast<std::uint32_t>(rank);
    count_ = static_cast<std::uint32_t>(count);
}

RankPeers::~RankPeers() { MPI_Comm_free(&ranks_); }

void RankPeers::send(std::uint32_t to, const Bytes& message) {
    const auto rank = static_cast<int>(to);
    const std::uint64_t size = message.size();
    std::vector<MPI_Request> parts(1);
    check(MPI_Isend(&size, sizeof size, MPI_BYTE, rank, tag_of_size, ranks_, parts.data()),
          "a rank cannot be told");
    for (std::size_t begin = 0; begin < size; begin += most_bytes)
        check(MPI_Isend(message.data() + begin,
                        static_cast<int>(std::min<std::size_t>(most_bytes, size - begin)), MPI_BYTE,
                        rank, tag_of_part, ranks_, &parts.emplace_back()),
              "a rank cannot be told");
    // The other may be sending to this one. MPI need not keep what nobody takes in, however short.
    while (!are_sent(parts))
        if (std::optional<Letter> letter = next_letter())
            came_meanwhile_.push_back(std::move(*letter));
        else
            std::this_thread::yield();
}

std::optional<Peers::Letter> RankPeers::receive() {
    if (came_meanwhile_.empty()) return next_letter();
    Letter first = std::move(came_meanwhile_.front());
    came_meanwhile_.pop_front();
    return first;
}

/// A message that MPI has, if any.
std::optional<Peers::Letter> RankPeers::next_letter() {
    int has_come = 0;
    MPI_Status status;
    check(MPI_Iprobe(MPI_ANY_SOURCE, tag_of_size, ranks_, &has_come, &status),
          "no rank can be heard");
    if (has_come == 0) return std::nullopt;
    const int from = status.MPI_SOURCE;
    std::uint64_t size = 0;
    check(MPI_Recv(&size, sizeof size, MPI_BYTE, from, tag_of_size, ranks_, MPI_STATUS_IGNORE),
          "a rank cannot be heard");
    Letter letter{static_cast<std::uint32_t>(from), Bytes(size)};
    // All parts are on their way: who sends begins with all of them, and only then waits.
    for (std::size_t begin = 0; begin < size; begin += most_bytes)
        check(MPI_Recv(letter.bytes.data() + begin,
                       static_cast<int>(std::min<std::size_t>(most_bytes, size - begin)), MPI_BYTE,
                       from, tag_of_part, ranks_, MPI_STATUS_IGNORE),
              "a rank cannot be heard");
    return letter;
}

}  // namespace mir::mpi
