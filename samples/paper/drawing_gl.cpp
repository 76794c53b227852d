#include "drawing.h"
#include "view.h"
#include "window.h"

namespace vfit::tools {

namespace {

constexpr int kSamples = 4;  // a pixel, as the room has them

class RoomDrawing : public Drawing {
public:
    RoomDrawing(int width, int height)
        : window_(room::open_offscreen(width, height)),
          renderer_(room::renderer()),
          view_(width, height, kSamples) {}

    room::BodyVertex* map_body(const room::Room& room) override { return view_.map_body(room); }
    void unmap_body() override { view_.unmap_body(); }
    room::ClothVertex* map_cloth(const room::Room& room) override { return view_.map_cloth(room); }
    void unmap_cloth() override { view_.unmap_cloth(); }
    void draw(const room::Room& room, float seconds) override {
        view_.draw(room, {true, false, seconds}, window_->framebuffer());
        window_->present();
    }
    const std::string& renderer() const override { return renderer_.name; }
    bool is_software() const override { return renderer_.software; }

private:
    const std::unique_ptr<room::Window> window_;
    const room::Renderer renderer_;
    room::View view_;
};

}  // namespace

std::unique_ptr<Drawing> open_drawing(int width, int height) {
    return std::make_unique<RoomDrawing>(width, height);
}

}  // namespace vfit::tools
