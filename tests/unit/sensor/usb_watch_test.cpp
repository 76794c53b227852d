// What plug-ins declare of USB; the watch itself is tested with cameras of umockdev (tests/openni2).
#include <gtest/gtest.h>

#include "fake_plugin.h"
#include "sensor/usb_watch.h"

namespace vfit::test {
namespace {

TEST(UsbIds, AreReadAsTheyAreWritten) {
    const std::vector<UsbId> ids = parse_usb_ids("1d27:0609,045E:02ae");
    ASSERT_EQ(ids.size(), 2u);
    EXPECT_EQ(ids[0].vendor, 0x1d27);
    EXPECT_EQ(ids[0].product, 0x0609);
    EXPECT_EQ(ids[1].vendor, 0x045e);
    EXPECT_EQ(ids[1].product, 0x02ae);
    EXPECT_TRUE(parse_usb_ids("").empty());
}

TEST(UsbIds, AnythingElseIsRefusedWithItsText) {
    for (const char* text : {"1d27", "1d27:0609,", ",1d27:0609", "1d27-0609", "1d27:060",
                             "1d27:0609 045e:02ae", "1d2g:0609", "-d27:0609", "0x1d27:0609"}) {
        const Failure failure = failure_of([&] { parse_usb_ids(text); });
        EXPECT_EQ(failure.code, VFIT_ERROR_PLUGIN) << text;
        EXPECT_TRUE(failure.says(text)) << text;
    }
}

TEST(UsbIds, APluginWithWrongOnesIsNotLetIn) {
    FakeHost fake;
    fake.plugin.table.usb_ids = "1d27/0609";
    const Failure failure = failure_of([&] { fake.attach(); });
    EXPECT_EQ(failure.code, VFIT_ERROR_PLUGIN);
    EXPECT_TRUE(failure.says("fake.so"));
    EXPECT_TRUE(failure.says("1d27/0609"));
    fake.plugin.table.usb_ids = "1d27:0609";
    fake.attach();
    EXPECT_EQ(fake.host.plugins().size(), 1u);
}

TEST(UsbIds, TheListMayHaveChangedWhenAPluginIsLoaded) {
    FakeHost fake;
    const uint64_t before = fake.host.changes();
    fake.attach();
    EXPECT_GT(fake.host.changes(), before);
}

}  // namespace
}  // namespace vfit::test
