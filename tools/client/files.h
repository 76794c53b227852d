// Files of the user: read whole, folders made, each failure with the path in it.
#pragma once

#include <string>

namespace vfit::tools {

std::string read_text(const std::string& path);
/// With its parents; may exist.
void create_folder(const std::string& path);
void write_text(const std::string& path, const std::string& text);
/// The same, whole or not at all: a program that reads it meanwhile, or when this one was killed, finds the
/// old text or the new one.
void replace_text(const std::string& path, const std::string& text);

}  // namespace vfit::tools
