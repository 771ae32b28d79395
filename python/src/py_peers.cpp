// SPDX-License-Identifier: MIT
#include "py_peers.hpp"

#include "errors.hpp"

#include <nanobind/stl/pair.h>

#include <string>
#include <utility>

namespace nb = nanobind;

namespace mirpy {
namespace {

/// "ConnectionError: the line is dead".
std::string words_of(const nb::python_error& raised) {
    return std::string(nb::type_name(raised.type()).c_str()) + ": " +
           nb::str(raised.value()).c_str();
}

/// Calls `work` with the GIL. What Python raises there becomes an error of the library, because the
/// team tells the other processes.
template <class Work>
auto with_gil(const Work& work) {
    const nb::gil_scoped_acquire gil;
    try {
        return work();
    } catch (const nb::python_error& raised) {
        throw mir::Error(mir::ErrorCode::device,
                         "processes of a team cannot talk to each other (" + words_of(raised) +
                             "); see to it that all run and reach each other");
    }
}

std::uint32_t number_of(nb::handle carrier, const char* method) {
    std::uint32_t number = 0;
    if (!nb::try_cast(carrier.attr(method)(), number))
        throw ArgumentError("peers", std::string(method) +
                                         "() gives no number (processes count from 0); return an "
                                         "int that is not negative");
    return number;
}

}  // namespace

PyPeers::PyPeers(nb::object carrier)
    : carrier_(std::move(carrier)),
      rank_(number_of(carrier_, "rank")),
      count_(number_of(carrier_, "count")) {
    if (rank_ >= count_)
        throw ArgumentError("peers", "process " + std::to_string(rank_) + " is none of " +
                                         std::to_string(count_) +
                                         "; count from 0, to the number of all but one");
}

void PyPeers::send(std::uint32_t to, const Bytes& message) {
    with_gil([&] { carrier_.attr("send")(to, nb::bytes(message.data(), message.size())); });
}

std::optional<mir::Peers::Letter> PyPeers::receive() {
    return with_gil([&]() -> std::optional<Letter> {
        const nb::object come = carrier_.attr("receive")();
        if (come.is_none()) return std::nullopt;
        std::pair<std::uint32_t, nb::bytes> pair;
        if (!nb::try_cast(come, pair))
            throw ArgumentError("peers",
                                "receive() gives no pair of the sender's number and bytes; return "
                                "that, or None where no message has come");
        const auto* const first = static_cast<const std::byte*>(pair.second.data());
        return Letter{pair.first, Bytes(first, first + pair.second.size())};
    });
}

}  // namespace mirpy
