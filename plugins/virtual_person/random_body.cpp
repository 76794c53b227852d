#include "random_body.h"

#include "random.h"

namespace vfit::virtual_person {

namespace {

struct Range {
    const char* key;
    float least,
        most;  // of the key's range 0 to 1: without the extremes, where the model's people look unlike any
};
constexpr Range kRanges[] = {
    {"height", 0.15f, 0.85f}, {"weight", 0.25f, 0.9f}, {"muscle", 0.25f, 0.8f}, {"proportions", 0.25f, 0.8f}};

}  // namespace

RandomBody draw_body(uint64_t number, vfit_sex sex, const std::map<std::string, float>& given) {
    const uint64_t key = random_bits(0x626F6479ull, number);
    RandomBody body{sex, given};
    if (sex == VFIT_SEX_UNKNOWN) body.sex = uniform(key, 0) < 0.5f ? VFIT_SEX_FEMALE : VFIT_SEX_MALE;
    uint64_t i = 1;
    for (const Range& range : kRanges)
        body.shape.emplace(range.key, range.least + (range.most - range.least) * uniform(key, i++));
    return body;
}

}  // namespace vfit::virtual_person
