// JSON that leaves the programs. Paths and names may hold bytes that are not UTF-8: they are replaced, so
// that a strange file name does not cost the result of the work.
#pragma once

#include <string>

#include "client/client.h"

namespace vfit::tools {

/// The whole of a report, indented.
std::string document_text(const Json& document);
void print_document(const Json& document);

/// One item of JSON lines, flushed: whoever reads a live sensor through a pipe gets each frame at once.
void print_line(const Json& item);

}  // namespace vfit::tools
