#include "subjects.h"

#include <algorithm>
#include <locale>
#include <sstream>

namespace vfit::tools {

namespace {

constexpr double kNavelShare = 0.6;              // of stature; no measure of the paper's goes by it
constexpr float kObese = 1.05f;                  // of the body's weight, 0 to 1.15: subject 6
constexpr double kUsual_m = 2.7, kTall_m = 3.2;  // from the camera: all of the person is in view

struct Printed {
    int number;
    vfit_sex sex;
    float weight;
    PrintedDimension shoulder, height;
};
constexpr Printed kTable3[] = {
    {1, VFIT_SEX_FEMALE, 0.5f, {43, 43.6, 1.0, 7.8}, {172, 170.8, 0.6, 2.5}},
    {2, VFIT_SEX_MALE, 0.5f, {46, 44.3, 3.0, 8.5}, {176, 172.1, 2.0, 1.4}},
    {3, VFIT_SEX_MALE, 0.6f, {51, 48.8, 4.0, 12.1}, {176, 174.0, 1.0, 6.6}},
    {4, VFIT_SEX_MALE, 0.5f, {48, 50.0, 4.0, 2.5}, {188, 191.0, 1.5, 7.1}},
    {5, VFIT_SEX_FEMALE, 0.5f, {44, 42.6, 3.0, 4.2}, {178, 175.8, 1.2, 3.1}},
    {6, VFIT_SEX_FEMALE, kObese, {48, 52.5, 9.0, 9.5}, {162, 158.4, 2.2, 6.1}},
    {7, VFIT_SEX_MALE, 0.55f, {52, 50.3, 3.4, 7.4}, {203, 206.2, 1.5, 6.7}},
};

}  // namespace

std::vector<Subject> subjects(const std::shared_ptr<const BodyModel>& body) {
    std::vector<Subject> out;
    for (const vfit_sex sex : {VFIT_SEX_FEMALE, VFIT_SEX_MALE}) {
        const auto measure = [&](const std::vector<float>& shape) {
            return measures_of(body, sex, shape, kNavelShare);
        };
        BodyWithMeasures solver(body, sex,
                                {{"height", 0.5, 0.4},
                                 {"measure-shoulder-dist", 0.0, 0.5},
                                 {"measure-upperleg-height", 0.0, 0.3},
                                 {"measure-lowerleg-height", 0.0, 0.3}},
                                {"stature_m", "shoulder_breadth_m"}, measure);
        for (const Printed& p : kTable3) {
            if (p.sex != sex) continue;
            std::vector<float> shape = body->default_shape(sex);
            shape[size_t(body->parameter("weight"))] = p.weight;
            Subject subject{p.number, sex, p.shoulder, p.height, "", {}, {}};
            subject.measures = solver.solve({{"stature_m", 0.01 * p.height.real, 0.001},
                                             {"shoulder_breadth_m", 0.01 * p.shoulder.real, 0.002}},
                                            measure, shape);
            std::ostringstream uri;
            uri.imbue(std::locale::classic());
            uri.precision(7);
            uri << "virtual:motion=scan&sensor=kinect_v1&seed=" << p.number
                << "&sex=" << (sex == VFIT_SEX_FEMALE ? "f" : "m")
                << "&distance=" << (p.height.real > 190.0 ? kTall_m : kUsual_m);
            const std::vector<float> usual = body->default_shape(sex);
            for (size_t i = 0; i < shape.size(); ++i) {
                if (shape[i] == usual[i]) continue;
                const std::string& key = body->parameters()[i].key;
                uri << "&" << key << "=" << shape[i];
                vfit_shape_value value = vfit_shape_value_init();
                value.value = shape[i];
                key.copy(value.key, sizeof value.key - 1);
                subject.shape.push_back(value);
            }
            subject.uri = uri.str();
            out.push_back(std::move(subject));
        }
    }
    std::sort(out.begin(), out.end(), [](const Subject& a, const Subject& b) { return a.number < b.number; });
    return out;
}

}  // namespace vfit::tools
