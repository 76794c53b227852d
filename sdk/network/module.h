// What the loadable network module gives the library: one symbol, vfit_joint_network. It is a module of its
// own so that a host that brings its own joints ships no network run time.
#pragma once

#include <stdint.h>

#define VFIT_JOINT_NETWORK_VERSION 1u

/// Functions return null or 0 where they fail and then write a sentence to `error`.
typedef struct vfit_joint_network_table {
    uint32_t version;
    /// An ONNX file: "crop" 1 x 1 x side x side in; "maps" 1 x 2n x m x m and "answers" 1 x 2 out.
    void* (*open)(const char* path, char* error, uint32_t capacity);
    void (*close)(void* network);
    /// Values are copied to maps (map_count floats) and answers (answer_count).
    int (*run)(void* network, const float* crop, uint32_t side, float* maps, uint32_t map_count,
               float* answers, uint32_t answer_count, char* error, uint32_t capacity);
} vfit_joint_network_table;

typedef const vfit_joint_network_table* (*vfit_joint_network_fn)(void);
