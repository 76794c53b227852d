// vfit-crops: an endless stream of labelled training crops on standard output (binary Sample records), or a
// few of them as pictures.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

#include "sample.h"

int main(int argc, char** argv) {
    try {
        if (argc != 5) {
            std::fprintf(stderr, "usage: vfit-crops BODY_BIN SEED FIRST COUNT > SAMPLES\n");
            return 2;
        }
        const auto model = vfit::BodyModel::load(argv[1]);
        const uint64_t seed = std::stoull(argv[2]), first = std::stoull(argv[3]),
                       count = std::stoull(argv[4]);
        vfit::training::Sampler sampler(model, seed);
        vfit::training::Sample sample;
        for (uint64_t i = 0; i < count; ++i) {
            sampler.make(first + i, sample);
            if (std::fwrite(&sample, sizeof sample, 1, stdout) != 1) return 0;  // the reader has enough
        }
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "vfit-crops: %s\n", e.what());
        return 1;
    }
}
