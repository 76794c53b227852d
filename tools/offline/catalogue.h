// Many designs: each is cooked by a process of its own, so that a fault, a long one or a kill costs one.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "client/client.h"

namespace vfit::tools {

struct CatalogueOptions {
    std::string folder, out;
    std::function<bool(const std::string& path)> is_mesh;    // by its ending
    std::function<bool(const std::string& path)> is_design;  // of JSON files: false where they are none
    std::vector<std::string> cook;                           // options of vfit cook, for every design
    int jobs = 1;                                            // processes at once
    double limit_s = 300.0;                                  // for each design
    bool resume = false;  // what the journal in `out` holds is not cooked again
};

/// Garment files and pictures in `out`, and there the report as it grows: report.json, report.html.
/// tell is called for each design as soon as it ended. Returns the report.
Json cook_catalogue(const CatalogueOptions& options, const std::function<void(const Json& design)>& tell);

/// The report's page, with pictures that lie beside it.
std::string catalogue_page(const Json& report);

}  // namespace vfit::tools
