// Records a device into an .oni file with OpenNI2's own recorder:  openni2_record FILE FRAMES [color] (color:
// without depth)
#include <cstdio>
#include <cstdlib>

#include <OpenNI.h>

int main(int count, char** words) {
    if (count != 3 && count != 4) return 2;
    const int frames = std::atoi(words[2]);
    const bool with_depth = count == 3;
    using namespace openni;
    const auto need = [](Status status, const char* what) {
        if (status == STATUS_OK) return;
        std::fprintf(stderr, "%s: %s\n", what, OpenNI::getExtendedError());
        std::_Exit(1);
    };
    need(OpenNI::initialize(), "initialize");
    {
        Device device;
        need(device.open(ANY_DEVICE), "open");
        device.setImageRegistrationMode(IMAGE_REGISTRATION_DEPTH_TO_COLOR);
        VideoStream depth, color;
        need(depth.create(device, SENSOR_DEPTH), "depth");
        need(color.create(device, SENSOR_COLOR), "color");
        Recorder recorder;
        need(recorder.create(words[1]), "recorder");
        if (with_depth) need(recorder.attach(depth), "attach depth");
        need(recorder.attach(color), "attach color");
        need(recorder.start(), "record");
        if (frames > 0) {
            need(color.start(), "start color");
            need(depth.start(), "start depth");
        }
        VideoFrameRef frame;
        for (int i = 0; i < frames; ++i) need(depth.readFrame(&frame), "read");
        recorder.stop();
        depth.stop();
        color.stop();
        recorder.destroy();
        frame.release();
        depth.destroy();
        color.destroy();
        device.close();
    }
    OpenNI::shutdown();
}
