/* The public headers compile as C99, alone and without warnings (see CMakeLists.txt for the flags). */
#include "vfit_plugin.h"

int main(void) {
    vfit_context_desc desc = vfit_context_desc_init();
    return desc.struct_size == sizeof desc ? 0 : 1;
}
