// What every part of the binding shares: errors as exceptions, lifetimes, lists and texts of the C ABI.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cstring>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "vfit.h"

namespace vfit_python {

namespace py = pybind11;
using namespace py::literals;

/// A failed call of the library, or of the binding itself; becomes vfit.Error.
class Failure : public std::runtime_error {
public:
    Failure(vfit_result result, const std::string& message) : std::runtime_error(message), result_(result) {}
    vfit_result result() const { return result_; }

private:
    vfit_result result_;
};

[[noreturn]] void fail(vfit_result result, const std::string& message);

/// News (>= 0) pass through; an error is thrown with the library's own sentence.
vfit_result check(vfit_result result);

/// A call that waits or computes: other Python threads run meanwhile.
template <typename Call>
vfit_result run(Call&& call) {
    vfit_result result;
    {
        py::gil_scoped_release released;
        result = call();
    }
    return check(result);
}

/// An object of the library that Context.close() closes.
class Closable {
public:
    virtual ~Closable() = default;
    virtual void close() = 0;
};

/// The library's context. Objects, frames and arrays share it, and the last of them destroys it: so an array
/// may outlive the Context that its pixels came from.
class Core : public std::enable_shared_from_this<Core> {
public:
    explicit Core(const vfit_context_desc& desc);
    ~Core();
    Core(const Core&) = delete;
    Core& operator=(const Core&) = delete;

    /// The handle, for whoever still holds something of a closed context.
    vfit_context handle() const { return handle_; }
    /// The handle for new things; fails where the context was closed.
    vfit_context open_handle() const;
    bool closed() const { return closed_; }

    /// Closes all objects; frames and arrays stay.
    void close();
    void add(const std::shared_ptr<Closable>& object) { objects_[object.get()] = object; }
    void remove(Closable* object) { objects_.erase(object); }

    /// At the end of the process: no thread of a device may run on into the unloading of libraries.
    static void close_all();

private:
    vfit_context handle_{};
    bool closed_ = false;
    std::map<Closable*, std::weak_ptr<Closable>> objects_;
};

/// A handle of the library and what it needs to stay valid. Destroyed by close(), or else by the destructor.
template <typename T, vfit_result (*kDestroy)(T)>
class Owned : public Closable {
public:
    Owned(std::shared_ptr<Core> core, T handle) : core_(std::move(core)), handle_(handle) {}
    ~Owned() override {
        core_->remove(this);
        if (handle_.id) kDestroy(handle_);
    }
    Owned(const Owned&) = delete;
    Owned& operator=(const Owned&) = delete;

    T get() const {
        if (!handle_.id) fail(VFIT_ERROR_HANDLE, "this object was closed");
        return handle_;
    }
    const std::shared_ptr<Core>& core() const { return core_; }
    bool closed() const { return handle_.id == 0; }
    void close() override {
        const T handle = handle_;
        if (!handle.id) return;
        vfit_result result;
        {
            py::gil_scoped_release released;
            result = kDestroy(handle);
        }
        // Somebody is inside an exclusive call: it is still ours to close. Stale: its parent took it along.
        if (result != VFIT_ERROR_BUSY) handle_ = T{};
        if (result != VFIT_ERROR_HANDLE) check(result);
    }

private:
    const std::shared_ptr<Core> core_;
    T handle_;
};

/// A new object that the context knows of.
template <typename T, typename... Arguments>
std::shared_ptr<T> make(const std::shared_ptr<Core>& core, Arguments&&... arguments) {
    auto object = std::make_shared<T>(core, std::forward<Arguments>(arguments)...);
    core->add(object);
    return object;
}

/// All items of a list call: list<vfit_joint>([&](auto* items, uint32_t stride, uint32_t* count) {...}).
template <typename T, typename Call>
std::vector<T> list(Call&& call) {
    uint32_t count = 0;
    run([&] { return call(static_cast<T*>(nullptr), static_cast<uint32_t>(sizeof(T)), &count); });
    for (;;) {
        std::vector<T> items(count);
        if (count == 0) return items;
        vfit_result result;
        {
            py::gil_scoped_release released;
            result = call(items.data(), static_cast<uint32_t>(sizeof(T)), &count);
        }
        // It grew between the two calls: count holds the new need.
        if (result == VFIT_ERROR_CAPACITY && count > items.size()) continue;
        check(result);
        items.resize(count);
        return items;
    }
}

/// The same for the functions that need nothing but a handle: list(vfit_avatar_rig, avatar.get()).
template <typename T, typename Handle>
std::vector<T> list(vfit_result (*call)(Handle, T*, uint32_t, uint32_t*), Handle handle) {
    return list<T>(
        [=](T* items, uint32_t stride, uint32_t* count) { return call(handle, items, stride, count); });
}

/// A whole text: text([&](char* buffer, uint32_t capacity) { return vfit_joint_name(...); }).
template <typename Call>
std::string text(Call&& call) {
    std::string out(call(nullptr, 0u), '\0');
    if (!out.empty()) call(out.data(), static_cast<uint32_t>(out.size() + 1));
    return out;
}

/// Text of a fixed field.
template <size_t N>
std::string field(const char (&chars)[N]) {
    return {chars, strnlen(chars, N)};
}

/// Text into a fixed field; `what` names it where it is too long.
template <size_t N>
void set_field(char (&chars)[N], const std::string& value, const char* what) {
    if (value.size() >= N) fail(VFIT_ERROR_ARGUMENT, std::string("\"") + value + "\" is no " + what);
    value.copy(chars, N - 1);
}

/// A class of the package: of vfit/values.py, or an enum of vocabulary.cpp.
inline py::object type(const char* name) { return py::module_::import("vfit").attr(name); }

/// An object of it.
template <typename... Arguments>
py::object value(const char* name, Arguments&&... arguments) {
    return type(name)(std::forward<Arguments>(arguments)...);
}

/// An optional number where the library takes 0 for "default" and a negative one for 0.
float setting(const std::optional<float>& given);

/// The value of a word; an unknown word fails, naming the argument and all words.
inline int32_t choice(const std::string& word, const char* name,
                      std::initializer_list<std::pair<const char*, int32_t>> words) {
    std::string known;
    for (const auto& [text, value] : words) {
        if (word == text) return value;
        known += std::string(known.empty() ? "\"" : ", \"") + text + "\"";
    }
    fail(VFIT_ERROR_ARGUMENT, std::string(name) + ": \"" + word + "\" is none of " + known);
}

inline uint32_t flag(bool on, uint32_t bit) { return on ? bit : 0u; }

/// "0.2.0"
std::string version_text(uint32_t version);

/// A float vector as a tuple.
template <size_t N>
py::tuple tuple_of(const float (&v)[N]) {
    py::tuple out(N);
    for (size_t i = 0; i < N; ++i) out[i] = py::float_(v[i]);
    return out;
}

using FloatArray = py::array_t<float, py::array::c_style | py::array::forcecast>;

/// close(), closed and the with statement for the class of an Owned.
template <typename Class>
void closable(Class& type) {
    using T = typename Class::type;
    type.def("close", [](T& object) { object.close(); })
        .def_property_readonly("closed", [](const T& object) { return object.closed(); })
        .def("__enter__", [](py::object self) { return self; })
        .def("__exit__", [](T& object, const py::args&) { object.close(); });
}

void bind_vocabulary(py::module_& m);
void bind_context(py::module_& m);
void bind_frame(py::module_& m);
void bind_sensor(py::module_& m);
void bind_recorder(py::module_& m);
void bind_tracker(py::module_& m);
void bind_scan(py::module_& m);
void bind_size(py::module_& m);
void bind_population(py::module_& m);
void bind_avatar(py::module_& m);
void bind_motion(py::module_& m);
void bind_pose_formats(py::module_& m);
void bind_cloth(py::module_& m);

}  // namespace vfit_python
