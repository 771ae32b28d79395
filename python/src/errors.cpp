// SPDX-License-Identifier: MIT
#include "errors.hpp"

#include "picture_words.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <exception>

namespace nb = nanobind;

namespace mirpy {
namespace {

struct NamedCode {
    mir::ErrorCode code;
    const char* name;
};

constexpr NamedCode named_codes[] = {{mir::ErrorCode::invalid_argument, "invalid_argument"},
                                     {mir::ErrorCode::invalid_input, "invalid_input"},
                                     {mir::ErrorCode::limit_exceeded, "limit_exceeded"},
                                     {mir::ErrorCode::unsupported, "unsupported"},
                                     {mir::ErrorCode::no_device, "no_device"},
                                     {mir::ErrorCode::device, "device"},
                                     {mir::ErrorCode::out_of_memory, "out_of_memory"},
                                     {mir::ErrorCode::io, "io"},
                                     {mir::ErrorCode::cancelled, "cancelled"},
                                     {mir::ErrorCode::internal, "internal"}};

const char* name_of(mir::ErrorCode code) {
    for (const NamedCode& known : named_codes)
        if (known.code == code) return known.name;
    return "internal";
}

void raise(const mir::Error& e, const std::string& place) {
    const nb::object type = nb::module_::import_("mir._error").attr("Error");
    const nb::object error = type(e.what(), name_of(e.code()), place);
    PyErr_SetObject(type.ptr(), error.ptr());
}

/// "--direct-samples" as Python spells it.
std::string keyword_of(const std::string& setting) {
    std::string name = setting.substr(std::min(setting.find_first_not_of('-'), setting.size()));
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

/// "check_scene.hpp:48", for reports of bugs.
std::string line_of(mir::Where where) {
    const std::string file = where.file;
    return file.substr(file.rfind('/') + 1) + ":" + std::to_string(where.line);
}

void translate(const std::exception_ptr& failure, void* /*payload*/) {
    try {
        std::rethrow_exception(failure);
    } catch (const ArgumentError& e) {
        raise(e, e.place);
    } catch (const mirtool::SettingError& e) {
        raise(e, keyword_of(e.setting));
    } catch (const mir::Error& e) {
        raise(e, line_of(e.where()));
    }
}

}  // namespace

mir::ErrorCode code_named(const std::string& name) {
    for (const NamedCode& known : named_codes)
        if (known.name == name) return known.code;
    return mir::ErrorCode::internal;
}

void register_errors() { nb::register_exception_translator(translate); }

}  // namespace mirpy
