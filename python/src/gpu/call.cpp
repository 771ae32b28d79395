// SPDX-License-Identifier: MIT
#include "gpu/call.hpp"

#include "arrays.hpp"
#include "errors.hpp"
#include "gpu/kernels.hpp"

#include <map>
#include <utility>

namespace nb = nanobind;

namespace mirpy::gpu {

const mir::cuda::Backend& backend_of(int device) {
    // Never destroyed: at the end of the process CUDA may be gone before.
    static auto& all = *new std::map<int, mir::cuda::Backend>;
    const auto found = all.find(device);
    if (found != all.end()) return found->second;
    return all.emplace(device, mir::cuda::Backend(mir::cuda::select_device(device))).first->second;
}

int device_of(nb::handle array) {
    if (!array.is_valid() || !nb::hasattr(array, "__dlpack_device__")) return -1;
    try {
        const nb::object place = array.attr("__dlpack_device__")();
        const auto number = [&](int i) { return nb::cast<int>(nb::int_(place[i])); };
        return number(0) == nb::device::cuda::value ? number(1) : -1;
    } catch (const nb::python_error&) {
        return -1;  // it is lent to nobody, which whoever reads it will say
    }
}

Call::~Call() {
    try {
        queue_.sync();
    } catch (const mir::Error&) {  // what failed is on its way to the caller already
    }
}

const Call::Array& Call::lend(nb::handle value, const std::string& place, Shape shape,
                              nb::dlpack::dtype_code kind, int bits) {
    if (device_of(value) != queue_.device())
        throw ArgumentError(place, "it does not lie on GPU " + std::to_string(queue_.device()) +
                                       ", as the first array does; put all of them there");
    const auto stream = reinterpret_cast<std::intptr_t>(queue_.stream());
    Array array;
    try {
        const nb::object capsule = value.attr("__dlpack__")(nb::arg("stream") = stream);
        if (!nb::try_cast(capsule, array))
            throw ArgumentError(place, "it is no array that DLPack can read; give one");
    } catch (const nb::python_error& e) {
        throw ArgumentError(place, "its owner does not lend it (" + std::string(e.what()) +
                                       "); give an array that DLPack can read");
    }
    check_shape(array, place, shape);
    const nb::dlpack::dtype type = array.dtype();
    if (type.code != static_cast<std::uint8_t>(kind) || type.bits != bits || type.lanes != 1)
        throw ArgumentError(place, "its dtype is " + dtype_text(array) + "; give " +
                                       (kind == nb::dlpack::dtype_code::Float ? "float" : "uint") +
                                       std::to_string(bits));
    lent_.push_back(std::move(array));
    return lent_.back();
}

void Call::check_finite(const StridedFloats& array, const std::array<std::size_t, 3>& sizes,
                        const std::string& place) {
    checks_.push_back({backend_.buffer<std::uint32_t>(1), place});
    queue_.clear(checks_.back().mark);
    mark_not_finite(queue_, array, sizes, checks_.back().mark.data());
}

void Call::finish() {
    {
        const nb::gil_scoped_release release;
        queue_.sync();
    }
    for (const Check& check : std::exchange(checks_, {})) {
        std::uint32_t is_marked = 0;
        queue_.download(check.mark, std::span(&is_marked, 1));
        queue_.sync();
        if (is_marked != 0)
            throw ArgumentError(check.place, "an element is NaN or infinite; repair it");
    }
}

Floats::Floats(Call& call, nb::handle value, const std::string& place, Call::Shape shape) {
    const Call::Array& array = call.lend(value, place, shape, nb::dlpack::dtype_code::Float, 32);
    view_.data = static_cast<const float*>(array.data());
    for (std::size_t i = 0; i < array.ndim(); ++i) {
        view_.strides[i] = array.stride(i);
        sizes_[i] = array.shape(i);
    }
    call.check_finite(view_, sizes_, place);
}

}  // namespace mirpy::gpu
