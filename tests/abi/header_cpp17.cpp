// The public headers compile as C++17, alone and without warnings.
#include "vfit_plugin.h"

int main() { return vfit_frame_desc_init().struct_size == sizeof(vfit_frame_desc) ? 0 : 1; }
