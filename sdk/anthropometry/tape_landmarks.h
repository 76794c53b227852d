// Landmarks and levels of a body's skin, each by a stated rule. Heights are in the body's own space.
// VFIT_ERROR_DATA where a body has none such.
#pragma once

#include "anthropometry/tape_mesh.h"

namespace vfit {

/// Where the legs part: the highest level whose sections of the two thighs are two loops.
float crotch_height(const TapeMesh& body);

/// Where the arm leaves the trunk: the highest level whose sections of arm and trunk are two loops, the lower
/// of the two sides.
float armpit_height(const TapeMesh& body);

/// Midway between the lowest rib and the iliac crest (ISO 8559-1 5.3.10). A mesh shows neither: the level is
/// taken at the share of the way from the hip joints to the joint at the foot of the neck at which it lies
/// in people. The narrowest level is another: it lies near the lowest rib, and stout bodies have none.
float waist_height(const TapeMesh& body);
/// That share; of an unknown sex the mean of both.
float waist_share(vfit_sex sex);

/// The navel, by the share at which it lies in people on the same way.
float navel_height(const TapeMesh& body);
float navel_share(vfit_sex sex);

/// Where the rib arch lies on it; bust and a man's chest lie above.
float rib_arch_share(vfit_sex sex);

/// Level of the smallest girth between navel and rib arch. Stout bodies, which have no narrow waist, have it
/// at one end.
float minimum_waist_height(const TapeMesh& body);

/// The bust point of the side: the middle of what stands out farthest before the straight line from the front
/// of the rib arch to the front between the armpits; some two millimetres under the skin.
Vec3 bust_point(const TapeMesh& body, Side side, float armpit);

/// Women: level of the bust points. Others: of the largest girth between the rib arch and a tape's half width
/// below the armpit.
float chest_height(const TapeMesh& body, float armpit);

/// Directly below the breasts: the place of the front's profile, through the bust point, that lies deepest
/// behind the straight line from the bust point down to the waist.
float underbust_height(const TapeMesh& body, float armpit, float waist);

/// Level of the largest girth between the crotch and halfway from the hip joints up to the waist.
float hip_height(const TapeMesh& body, float crotch, float waist);

/// Along the axis from the joint at the foot of the neck to the middle of the head.
TapeLimb neck_of(const TapeMesh& body);

/// Length of a closed line.
float length(const std::vector<Vec3>& loop);

/// Tape about the neck, square to its axis, that many metres along it. VFIT_ERROR_DATA where the axis does
/// not run inside the neck.
std::vector<Vec3> neck_loop(const TapeLimb& neck, float along_m);

/// Where along its axis the neck is narrowest: trapezius and jaw lie to the two sides, and both are wider.
float narrowest_neck(const TapeLimb& neck);

/// Where along the neck's axis the tape lies just below the larynx: its front is a third of the way down from
/// the chin to the collar bones. The chin is level with C3, the notch between the collar bones with T2 to T3,
/// the larynx ends at C5: two of six and a half vertebrae. A neck that is narrowest below that is measured
/// there.
float larynx_place(const TapeMesh& body, const TapeLimb& neck, float narrowest_m, float chin);

/// The skin over the outer edge of the acromion: where the line from the centre of the shoulder joint through
/// the bone's edge leaves the body. Of a checked body.
Vec3 acromion(const TapeBody& body, Side side);

/// Lowest point of the chin: of what lies above the throat and in front of the plane halfway between it and
/// the tip of the nose.
float chin_height(const TapeMesh& body, const TapeLimb& neck, float narrowest_m);

/// Largest breadth of the skull above the ears.
float skull_breadth(const TapeMesh& body, float chin);

/// Tip of the middle finger: the point of the hand farthest from the wrist.
Vec3 fingertip(const TapeMesh& body, Side side);

/// The largest tape about a limb, square to its axis, between a tape's half width below where the limb leaves
/// the body and that share of its length; `apart` runs through what it leaves.
float largest_limb_girth(const TapeMesh& body, const Axis& axis, float share, const Axis& apart);

}  // namespace vfit
