#include "core/json.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace vfit {
namespace {

std::string fault(const std::string& text) {
    try {
        parse_json(text, "thing");
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), VFIT_ERROR_DATA);
        return e.what();
    }
    return {};
}

TEST(Json, AFaultNamesTheThingAndThePlace) {
    for (const char* text : {"", "{", "{\"a\": 1,}", "[1] 2", "nan", "{\"a\": \"\\", "\"\xff\""}) {
        EXPECT_EQ(fault(text).find("thing: not JSON: "), 0u) << text;
    }
    EXPECT_NE(fault("{\n\"a\": x}").find("line 2"), std::string::npos);
}

TEST(Json, BracketsWithoutEndAreRefusedBeforeTheyCostMemory) {
    EXPECT_EQ(fault(std::string(50'000'000, '[')), "thing: nested deeper than 32 levels");
    EXPECT_EQ(fault(std::string(32, '[') + std::string(32, ']')), "");
}

TEST(Json, BracketsInsideATextAreNoLevels) {
    const std::string brackets(100, '[');
    EXPECT_EQ(parse_json("[\"\\\"" + brackets + "\"]", "thing")[0], "\"" + brackets);
}

}  // namespace
}  // namespace vfit
