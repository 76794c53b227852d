// Preview pictures: what is drawn is inside of them.
#include "picture/render.h"

#include <gtest/gtest.h>

namespace vfit::tools {
namespace {

/// A red bar from one end to the other, seen from all sides.
RenderMesh bar(const glm::vec3& from, const glm::vec3& to) {
    RenderMesh mesh;
    mesh.color = {1.0f, 0.1f, 0.1f};
    for (const glm::vec3& end : {from, to})
        for (const glm::vec3 side :
             {glm::vec3(0, 0.1f, 0), glm::vec3(0, 0, 0.1f), glm::vec3(0, -0.1f, -0.1f)})
            mesh.positions.push_back(end + side), mesh.normals.push_back(glm::normalize(side));
    for (const uint32_t i : {0u, 1u, 3u, 1u, 4u, 3u, 1u, 2u, 4u, 2u, 5u, 4u, 2u, 0u, 5u, 0u, 3u, 5u})
        mesh.indices.push_back(i);
    return mesh;
}

/// First and last column with red in it; {-1, -1}: none.
std::pair<int, int> red_columns(const RenderMesh& mesh, const RenderView& view) {
    const Canvas picture = render({mesh}, view);
    std::pair<int, int> columns(-1, -1);
    for (int x = 0; x < view.width; ++x)
        for (int y = 0; y < view.height; ++y) {
            const Color c = picture.get(x, y);
            if (c.r < 2.0f * c.b) continue;
            if (columns.first < 0) columns.first = x;
            columns.second = x;
        }
    return columns;
}

TEST(Render, StepsBackUntilHandsAreInsideThePicture) {
    const RenderMesh arms = bar({-0.9f, 1.4f, 0.2f}, {0.9f, 1.4f, -0.1f});
    RenderView view;
    view.width = 60, view.height = 90, view.samples = 1;
    view.eye = {0.8f, 1.2f, 2.5f};
    view.target = {0.0f, 0.9f, 0.0f};
    EXPECT_EQ(red_columns(arms, view), std::pair(0, 59)) << "the bar is cut off";
    step_back_to_show({arms}, view);
    const auto [first, last] = red_columns(arms, view);
    EXPECT_GE(first, 1);
    EXPECT_LE(last, 58);
    EXPECT_TRUE(first <= 4 || last >= 55) << "further away than it has to be: " << first << " " << last;
}

TEST(Render, StaysWhereAllIsShown) {
    RenderView view;
    const glm::vec3 eye = view.eye;
    step_back_to_show({bar({-0.3f, 1.0f, 0}, {0.3f, 1.0f, 0})}, view);
    EXPECT_EQ(view.eye, eye);
}

}  // namespace
}  // namespace vfit::tools
