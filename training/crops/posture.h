// A random posture of a person before a depth camera: what people do in a fitting room, and beyond it.
#pragma once

#include "body/skeleton.h"
#include "random.h"

namespace vfit::training {

/// Hips over the world's origin, facing +Z; the caller turns the body and puts its feet on the floor.
Pose random_posture(const Skeleton& skeleton, Random& random);

}  // namespace vfit::training
