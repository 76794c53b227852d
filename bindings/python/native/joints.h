// Joints, colliders and measurements between Python values and the arrays of vfit.h.
#pragma once

#include "frame.h"

namespace vfit_python {

/// From "LEFT_HAND" or Joint.LEFT_HAND.
vfit_joint_id joint_id(const py::handle& key);

/// vfit.Joints of a list.
py::object joints_out(const std::vector<vfit_joint>& joints);
py::object joints_of(const Frame& frame, uint32_t body_id);

/// From vfit.Joints, or a mapping of names or Joint to (x, y, z) or (x, y, z, confidence).
std::vector<vfit_joint> joints_in(const py::object& joints);

py::list colliders_out(const std::vector<vfit_collider>& colliders);

/// key -> vfit.Measurement.
py::dict measurements_out(const std::vector<vfit_measurement>& measurements);
/// From a mapping of keys to Measurement, (value, sigma, observed) or a number.
std::vector<vfit_measurement> measurements_in(const py::object& measurements);

/// From Sex, "f", "m" or None.
vfit_sex sex_in(const py::object& sex);

}  // namespace vfit_python
