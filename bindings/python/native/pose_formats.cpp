// Poses for other programs: packets of Open Sound Control, and BVH files.
#include "avatar.h"
#include "context.h"

namespace vfit_python {

namespace {

py::bytes pose_osc(const Context& context, const py::object& given, const std::string& kind) {
    vfit_pose pose = vfit_pose_init();
    const std::vector<vfit_bone> bones = pose_in(given, pose);
    const vfit_osc osc = choice(kind, "kind", {{"vmc", VFIT_OSC_VMC}, {"vrchat", VFIT_OSC_VRCHAT}});
    char packet[2048];
    uint32_t size = sizeof packet;
    run([&, c = context.handle()] {
        return vfit_pose_osc(c, &pose, bones.data(), sizeof(vfit_bone), static_cast<uint32_t>(bones.size()),
                             osc, packet, &size);
    });
    return py::bytes(packet, size);
}

py::str pose_bvh(const Context& context, const py::iterable& given, float frame_time_s) {
    std::vector<vfit_pose> poses;
    std::vector<vfit_bone> bones;
    for (const py::handle& item : given) {
        poses.push_back(vfit_pose_init());
        const std::vector<vfit_bone> of = pose_in(py::reinterpret_borrow<py::object>(item), poses.back());
        bones.insert(bones.end(), of.begin(), of.end());
    }
    const auto write = [&, c = context.handle()](char* text, uint32_t* capacity) {
        return vfit_pose_bvh(c, poses.data(), sizeof(vfit_pose), static_cast<uint32_t>(poses.size()),
                             bones.data(), sizeof(vfit_bone), static_cast<uint32_t>(bones.size()),
                             frame_time_s, text, capacity);
    };
    uint32_t capacity = 0;
    run([&] { return write(nullptr, &capacity); });
    std::string text(capacity, 0);
    run([&] { return write(text.data(), &capacity); });
    text.resize(capacity - 1);
    return py::str(text);
}

}  // namespace

void bind_pose_formats(py::module_& m) {
    py::reinterpret_borrow<py::class_<Context>>(m.attr("Context"))
        .def("pose_osc", &pose_osc, "pose"_a, "kind"_a = "vmc",
             "A pose as one UDP packet of Open Sound Control: 'vmc' or 'vrchat' (docs/motion.md).")
        .def("pose_bvh", &pose_bvh, "poses"_a, "frame_time_s"_a = 0.0f,
             "Poses in order of time as the text of a BVH file. frame_time_s 0: 1/30 s.");
}

}  // namespace vfit_python
