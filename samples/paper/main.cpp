// vfit-paper: what Gültepe & Güdükbay 2014 print, measured with vfit.
#include "paper.h"

int main(int argc, char** argv) {
    using namespace vfit::tools;
    return run_program("vfit-paper", "The paper's tables and figures, made with vfit.",
                       {add_tables, add_meshes, add_figures, add_limbs, add_rates, add_garments}, argc, argv);
}
