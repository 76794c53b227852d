// The names of vfit.h: its enums as IntEnum, joints, bones and measures as the library spells them.
#include <cctype>

#include "core.h"

namespace vfit_python {

namespace {

struct Member {
    std::string name;
    int value;
};

void add_enum(py::module_& m, const char* name, const std::vector<Member>& members, const char* doc) {
    py::list items;
    for (const Member& member : members) items.append(py::make_tuple(member.name, member.value));
    py::object type = py::module_::import("enum").attr("IntEnum")(name, items, "module"_a = "vfit");
    type.attr("__doc__") = doc;
    m.attr(name) = type;
}

/// "leftUpperArm" -> "LEFT_UPPER_ARM".
std::string upper_snake(const std::string& camel) {
    std::string out;
    for (const char c : camel) {
        if (std::isupper(static_cast<unsigned char>(c))) out += '_';
        out += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    return out;
}

std::string bone_name(vfit_bone_id bone) {
    return text([&](char* buffer, uint32_t capacity) { return vfit_bone_name(bone, buffer, capacity); });
}

std::vector<Member> results() {
    std::vector<Member> out;
    for (vfit_result r = VFIT_END_OF_STREAM; vfit_result_name(r)[0] != '?'; --r)
        out.push_back({vfit_result_name(r), r});
    return out;
}

std::vector<Member> joints() {
    std::vector<Member> out;
    for (int id = 0; id < static_cast<int>(VFIT_JOINT_COUNT); ++id)
        out.push_back({text([&](char* b, uint32_t n) { return vfit_joint_name(id, b, n); }), id});
    return out;
}

std::vector<Member> bones() {
    std::vector<Member> out;
    for (int id = 0; id < static_cast<int>(VFIT_BONE_COUNT); ++id)
        out.push_back({upper_snake(bone_name(id)), id});
    return out;
}

/// Key -> definition, in the library's order.
py::dict measures() {
    py::dict out;
    for (uint32_t i = 0;; ++i) {
        const std::string key = text([&](char* b, uint32_t n) { return vfit_measure_key(i, b, n); });
        if (key.empty()) return out;
        out[py::str(key)] = text([&](char* b, uint32_t n) { return vfit_measure_text(i, b, n); });
    }
}

}  // namespace

void bind_vocabulary(py::module_& m) {
    add_enum(m, "ResultCode", results(), "Result codes; errors are negative.");
    add_enum(m, "Joint", joints(), "What a sensor sees. LEFT is the person's own left.");
    add_enum(m, "Bone", bones(), "Humanoid bones by their VRM names, parents before children.");
    add_enum(m, "Axes",
             {{"RH_Y_UP", VFIT_AXES_RH_Y_UP}, {"UNITY", VFIT_AXES_UNITY}, {"UNREAL", VFIT_AXES_UNREAL}},
             "Convention of everything that a context reads and writes.");
    add_enum(m, "LogLevel",
             {{"ERROR", VFIT_LOG_ERROR},
              {"WARNING", VFIT_LOG_WARNING},
              {"INFO", VFIT_LOG_INFO},
              {"DEBUG", VFIT_LOG_DEBUG}},
             "Weight of a log line.");
    add_enum(m, "Stream",
             {{"DEPTH", VFIT_STREAM_DEPTH},
              {"COLOR", VFIT_STREAM_COLOR},
              {"USER_MAP", VFIT_STREAM_USER_MAP},
              {"POSITION", VFIT_STREAM_POSITION},
              {"NORMAL", VFIT_STREAM_NORMAL},
              {"UV", VFIT_STREAM_UV},
              {"INDEX", VFIT_STREAM_INDEX},
              {"BONE_MATRIX", VFIT_STREAM_BONE_MATRIX},
              {"SKIN_BONES", VFIT_STREAM_SKIN_BONES},
              {"SKIN_WEIGHTS", VFIT_STREAM_SKIN_WEIGHTS},
              {"STRAIN", VFIT_STREAM_STRAIN},
              {"PRESSURE", VFIT_STREAM_PRESSURE}},
             "The kinds of data in a frame.");
    add_enum(
        m, "FloorState",
        {{"DEFAULT", VFIT_FLOOR_DEFAULT}, {"ESTIMATED", VFIT_FLOOR_ESTIMATED}, {"GIVEN", VFIT_FLOOR_GIVEN}},
        "Who says where the floor is.");
    add_enum(m, "JointState",
             {{"NOT_SEEN", VFIT_JOINT_NOT_SEEN},
              {"INFERRED", VFIT_JOINT_INFERRED},
              {"MEASURED", VFIT_JOINT_MEASURED}},
             "How a joint was found.");
    add_enum(m, "ActiveState",
             {{"NOBODY", VFIT_ACTIVE_NOBODY},
              {"BY_RULE", VFIT_ACTIVE_BY_RULE},
              {"CHOSEN", VFIT_ACTIVE_CHOSEN},
              {"LOST", VFIT_ACTIVE_LOST}},
             "Why a person is the active one; LOST: out of sight and waited for.");
    add_enum(m, "Sex", {{"UNKNOWN", VFIT_SEX_UNKNOWN}, {"FEMALE", VFIT_SEX_FEMALE}, {"MALE", VFIT_SEX_MALE}},
             "Which default body; UNKNOWN: halfway.");
    add_enum(m, "ScanMethod",
             {{"DEFAULT", VFIT_SCAN_DEFAULT},
              {"PROPORTIONS", VFIT_SCAN_PROPORTIONS},
              {"PROPORTIONS_AS_PRINTED", VFIT_SCAN_PROPORTIONS_AS_PRINTED},
              {"FIT", VFIT_SCAN_FIT}},
             "How a scan measures; PROPORTIONS is the paper's way, FIT a body fitted to all frames.");
    add_enum(m, "DoubtKind",
             {{"UNLIKELY", VFIT_DOUBT_UNLIKELY},
              {"INCHES", VFIT_DOUBT_INCHES},
              {"POUNDS", VFIT_DOUBT_POUNDS},
              {"DIGIT", VFIT_DOUBT_DIGIT},
              {"SWAPPED", VFIT_DOUBT_SWAPPED}},
             "The slip that explains a measure which does not go with the others.");
    add_enum(m, "Guidance",
             {{"NONE", VFIT_GUIDANCE_NONE},
              {"STEP_BACK", VFIT_GUIDANCE_STEP_BACK},
              {"STEP_CLOSER", VFIT_GUIDANCE_STEP_CLOSER},
              {"ARMS_OUT", VFIT_GUIDANCE_ARMS_OUT},
              {"HOLD_STILL", VFIT_GUIDANCE_HOLD_STILL},
              {"TURN_SIDEWAYS", VFIT_GUIDANCE_TURN_SIDEWAYS},
              {"FEET_NOT_VISIBLE", VFIT_GUIDANCE_FEET_NOT_VISIBLE},
              {"ONE_PERSON_ONLY", VFIT_GUIDANCE_ONE_PERSON_ONLY},
              {"NOBODY", VFIT_GUIDANCE_NOBODY},
              {"JOINTS_MISSING", VFIT_GUIDANCE_JOINTS_MISSING},
              {"FACE_CAMERA", VFIT_GUIDANCE_FACE_CAMERA},
              {"TURN_ROUND", VFIT_GUIDANCE_TURN_ROUND},
              {"TURN_SLOWER", VFIT_GUIDANCE_TURN_SLOWER},
              {"ARMS_FORWARD", VFIT_GUIDANCE_ARMS_FORWARD}},
             "Why a scan did not take a frame.");

    py::tuple names(VFIT_BONE_COUNT), parents(VFIT_BONE_COUNT);
    for (int id = 0; id < static_cast<int>(VFIT_BONE_COUNT); ++id) {
        names[static_cast<size_t>(id)] = bone_name(id);
        parents[static_cast<size_t>(id)] = vfit_bone_parent(id);
    }
    m.attr("BONE_NAMES") = names;
    m.attr("BONE_PARENTS") = parents;
    m.attr("MEASURES") = measures();
}

}  // namespace vfit_python
