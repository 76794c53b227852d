#include "joints.h"

#include <algorithm>

namespace vfit_python {

namespace {

/// An array of Joints, which anybody may have made.
FloatArray rows_of(const py::object& joints, const char* name, const std::vector<py::ssize_t>& shape) {
    auto array = FloatArray::ensure(joints.attr(name));
    if (!array || !std::equal(shape.begin(), shape.end(), array.shape(), array.shape() + array.ndim()))
        fail(VFIT_ERROR_ARGUMENT, std::string("joints: ") + name + " has not one row of numbers a joint");
    return array;
}

}  // namespace

vfit_joint_id joint_id(const py::handle& key) {
    if (!py::isinstance<py::str>(key)) return key.cast<int>();
    const py::object members = type("Joint").attr("__members__");
    if (!members.contains(key)) fail(VFIT_ERROR_ARGUMENT, "\"" + key.cast<std::string>() + "\" is no joint");
    return members[key].cast<int>();
}

py::object joints_out(const std::vector<vfit_joint>& joints) {
    const auto n = static_cast<py::ssize_t>(joints.size());
    py::array_t<int32_t> ids(n), states(n);
    py::array_t<float> confidence(n), positions({n, py::ssize_t(3)}), rotations({n, py::ssize_t(4)});
    for (py::ssize_t i = 0; i < n; ++i) {
        const vfit_joint& j = joints[static_cast<size_t>(i)];
        ids.mutable_at(i) = j.joint;
        states.mutable_at(i) = j.state;
        confidence.mutable_at(i) = j.confidence;
        std::copy(std::begin(j.position), std::end(j.position), positions.mutable_data(i, 0));
        std::copy(std::begin(j.rotation), std::end(j.rotation), rotations.mutable_data(i, 0));
    }
    return value("Joints", ids, positions, confidence, states, rotations);
}

py::object joints_of(const Frame& frame, uint32_t body_id) {
    return joints_out(list<vfit_joint>([f = frame.get(), body_id](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_frame_joints(f, body_id, items, stride, n);
    }));
}

std::vector<vfit_joint> joints_in(const py::object& joints) {
    std::vector<vfit_joint> out;
    if (py::isinstance(joints, type("Joints"))) {
        const auto ids = joints.attr("ids").cast<std::vector<int>>();
        const auto states = joints.attr("states").cast<std::vector<int>>();
        const auto rows = static_cast<py::ssize_t>(ids.size());
        const auto positions = rows_of(joints, "positions", {rows, 3});
        const auto rotations = rows_of(joints, "rotations", {rows, 4});
        const auto confidence = rows_of(joints, "confidence", {rows});
        if (states.size() != ids.size()) fail(VFIT_ERROR_ARGUMENT, "joints: states and ids differ in length");
        for (size_t i = 0; i < ids.size(); ++i) {
            vfit_joint j = vfit_joint_init();
            j.joint = ids[i];
            j.state = states[i];
            j.confidence = confidence.at(i);
            std::copy_n(positions.data(i, 0), 3, j.position);
            std::copy_n(rotations.data(i, 0), 4, j.rotation);
            out.push_back(j);
        }
        return out;
    }
    for (const auto& [key, given] : py::dict(joints)) {
        const auto numbers = given.cast<std::vector<float>>();
        if (numbers.size() != 3 && numbers.size() != 4)
            fail(VFIT_ERROR_ARGUMENT, "joint " + py::str(key).cast<std::string>() +
                                          ": wanted is (x, y, z) or (x, y, z, confidence)");
        vfit_joint j = vfit_joint_init();
        j.joint = joint_id(key);
        j.state = VFIT_JOINT_MEASURED;
        j.confidence = numbers.size() == 4 ? numbers[3] : 1.0f;
        std::copy_n(numbers.begin(), 3, j.position);
        out.push_back(j);
    }
    return out;
}

py::list colliders_out(const std::vector<vfit_collider>& colliders) {
    py::list out;
    for (const vfit_collider& c : colliders) {
        const bool capsule = c.joint_b >= 0;
        out.append(value("Collider", value("Joint", c.joint), tuple_of(c.center), c.radius,
                         capsule ? value("Joint", c.joint_b) : py::none(),
                         capsule ? py::object(tuple_of(c.center_b)) : py::none(),
                         capsule ? c.radius_b : 0.0f));
    }
    return out;
}

py::dict measurements_out(const std::vector<vfit_measurement>& measurements) {
    py::dict out;
    for (const vfit_measurement& m : measurements)
        out[py::str(field(m.key))] = value("Measurement", m.value, m.sigma, m.observed != 0);
    return out;
}

std::vector<vfit_measurement> measurements_in(const py::object& measurements) {
    std::vector<vfit_measurement> out;
    for (const auto& [key, given] : py::dict(measurements)) {
        vfit_measurement m = vfit_measurement_init();
        set_field(m.key, key.cast<std::string>(), "measure");
        m.observed = 1;
        if (py::isinstance<py::tuple>(given)) {
            const auto parts = py::reinterpret_borrow<py::tuple>(given);
            if (parts.empty() || parts.size() > 3)
                fail(VFIT_ERROR_ARGUMENT, field(m.key) + ": wanted is (value, sigma, observed)");
            m.value = parts[0].cast<float>();
            if (parts.size() > 1) m.sigma = parts[1].cast<float>();
            if (parts.size() > 2) m.observed = parts[2].cast<bool>() ? 1 : 0;
        } else {
            m.value = given.cast<float>();
        }
        out.push_back(m);
    }
    return out;
}

vfit_sex sex_in(const py::object& sex) {
    if (sex.is_none()) return VFIT_SEX_UNKNOWN;
    if (!py::isinstance<py::str>(sex)) return sex.cast<int>();
    const auto letter = sex.cast<std::string>();
    if (letter == "f") return VFIT_SEX_FEMALE;
    if (letter == "m") return VFIT_SEX_MALE;
    fail(VFIT_ERROR_ARGUMENT, "sex: \"" + letter + "\" is neither \"f\" nor \"m\"");
}

}  // namespace vfit_python
