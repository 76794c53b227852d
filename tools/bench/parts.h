// A bench that is made of parts, each a table and its targets: one of them or all, and what they find as text
// or JSON.
#pragma once

#include <iostream>
#include <string>
#include <vector>

#include "bench/targets.h"
#include "client/output.h"

namespace vfit::tools {

template <typename Judge>
struct Part {
    const char* name;
    Json (*judge)(const Judge&);
};

template <typename Judge, size_t kCount>
std::vector<std::string> names_of(const Part<Judge> (&parts)[kCount]) {
    std::vector<std::string> names;
    for (const Part<Judge>& part : parts) names.emplace_back(part.name);
    return names;
}

/// only: the name of one, or empty.
template <typename Judge, size_t kCount>
void judge_parts(const Part<Judge> (&parts)[kCount], const std::string& only, const Judge& judge) {
    Json report = Json::object();
    for (const Part<Judge>& part : parts)
        if (only.empty() || only == part.name) report[part.name] = part.judge(judge);
    report["targets"] = judge.targets.json();
    if (judge.quiet)
        print_document(report);
    else
        std::cout << "\n"
                  << judge.targets.count() - judge.targets.missed() << " of " << judge.targets.count()
                  << " targets hit\n";
}

}  // namespace vfit::tools
