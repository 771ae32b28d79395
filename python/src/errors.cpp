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

const char* name_of(mir::ErrorCode code) {
    switch (code) {
        case mir::ErrorCode::invalid_argument:
            return "invalid_argument";
        case mir::ErrorCode::invalid_input:
            return "invalid_input";
        case mir::ErrorCode::limit_exceeded:
            return "limit_exceeded";
        case mir::ErrorCode::unsupported:
            return "unsupported";
        case mir::ErrorCode::no_device:
            return "no_device";
        case mir::ErrorCode::device:
            return "device";
        case mir::ErrorCode::out_of_memory:
            return "out_of_memory";
        case mir::ErrorCode::io:
            return "io";
        case mir::ErrorCode::cancelled:
            return "cancelled";
        case mir::ErrorCode::internal:
            break;
    }
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

void register_errors() { nb::register_exception_translator(translate); }

}  // namespace mirpy
