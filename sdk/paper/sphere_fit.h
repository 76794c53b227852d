// Algorithm 2 of the paper: the largest sphere around a joint that stays inside the visible body.
#pragma once

#include <array>

#include "frame/body.h"
#include "frame/camera.h"
#include "track/depth_filter.h"

namespace vfit {

/// Radius in metres, 0 where the joint is not seen or does not lie on the person in the image.
///
/// Corrections of what is printed: line 3 takes sqrt(Pz^2 - Dz^2), Eq. 3 r_z = J_z - D_z, which is the
/// distance from the joint to the surface before it and is used here; lines 5 to 18 wait for D to equal P_z,
/// which never happens exactly, so a direction ends where it leaves the user map or the depth jumps; Eq. 4
/// keeps the larger of x and y, the algorithm the smallest of all five directions, which is done here.
/// A direction that reaches the border of the image is discarded (section 3.2.2, step 2), and so is r_z of a
/// joint that the sensor puts in front of the surface.
float fit_sphere(const FilteredDepth& depth, const Camera& camera, const Vec3& joint);

/// For the paper's 15 joints.
std::array<float, kPaperJointCount> fit_spheres(const FilteredDepth& depth, const Camera& camera,
                                                const Body& body);

}  // namespace vfit
