// A pose as a packet of Open Sound Control for programs that animate avatars: the VMC protocol
// (protocol.vmc.info/marionette-spec) and VRChat's OSC trackers (docs.vrchat.com/docs/osc-trackers). Both are
// in Unity's frame: metre, Y up, left-handed, the character faces +Z with their left at -X.
#pragma once

#include <array>

#include "body/skeleton.h"

namespace vfit {

struct OscPacket {
    std::array<uint8_t, 2048> bytes;
    size_t size = 0;
};

OscPacket vmc_packet(const Skeleton& skeleton, const Pose& pose);
OscPacket vrchat_packet(const Skeleton& skeleton, const Pose& pose);

}  // namespace vfit
