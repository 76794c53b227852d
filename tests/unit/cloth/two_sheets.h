// Two square sheets above each other, for tests of contact between layers.
#pragma once

#include <vector>

#include "cloth/contact/triangle_groups.h"
#include "cloth/fabric/fabric.h"
#include "core/jobs.h"

namespace vfit::test {

/// Two square sheets of one mesh, n by n vertices each, `side` apart.
struct TwoSheets {
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;
    uint32_t of_one;

    TwoSheets(uint32_t n, float side, const Vec3& second) : of_one(n * n) {
        for (const Vec3& at : {Vec3(0.0f), second})
            for (uint32_t r = 0; r < n; ++r)
                for (uint32_t c = 0; c < n; ++c)
                    positions.push_back(at + Vec3(float(c) * side, 0.0f, float(r) * side));
        for (uint32_t sheet = 0; sheet < 2; ++sheet)
            for (uint32_t r = 0; r + 1 < n; ++r)
                for (uint32_t c = 0; c + 1 < n; ++c) {
                    const uint32_t a = sheet * n * n + r * n + c, b = a + 1, d = a + n, e = d + 1;
                    indices.insert(indices.end(), {a, d, e, a, e, b});
                }
    }
    FabricData fabric() const {
        FabricData data;
        data.indices = indices;
        data.inverse_mass.assign(positions.size(), 1.0f);
        return data;
    }
    std::vector<TrianglePair> crossed(bool flat_do_not = false) const {
        const auto jobs = Jobs::own(0);
        TriangleGroups groups(positions, indices);
        groups.move(positions, *jobs);
        std::vector<TrianglePair> pairs;
        groups.find_crossings(flat_do_not, pairs, *jobs);
        return pairs;
    }
};

}  // namespace vfit::test
