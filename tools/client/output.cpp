#include "client/output.h"

#include <iostream>

namespace vfit::tools {

namespace {

constexpr auto kReplace = Json::error_handler_t::replace;

}  // namespace

std::string document_text(const Json& document) { return document.dump(2, ' ', false, kReplace) + "\n"; }

void print_document(const Json& document) { std::cout << document_text(document); }

void print_line(const Json& item) {
    std::cout << item.dump(-1, ' ', false, kReplace) << "\n" << std::flush;
    if (!std::cout) throw Failure("standard output: cannot be written");
}

}  // namespace vfit::tools
