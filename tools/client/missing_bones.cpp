#include "client/missing_bones.h"

#include <iostream>

namespace vfit::tools {

void report_missing_bones(const Failure& failure, bool nodes) {
    const std::string all = failure.what();
    const size_t end = all.find('\n');
    if (end == std::string::npos) throw failure;
    if (!nodes) throw Failure(all.substr(0, end) + " --nodes prints one to fill in");
    std::cout << all.substr(end + 1);
}

}  // namespace vfit::tools
