#pragma once

/// Compiles a function once per vector instruction set and picks one at load time; results are the same bits
/// (floats are never contracted or reordered). Not under sanitizers, whose runtime is not ready yet when the
/// choice is made, and not by clang, which cannot also flatten such functions.
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__) || !defined(__x86_64__) || \
    defined(__clang__)
#define REAM_VECTOR_CLONES
#else
#define REAM_VECTOR_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#endif
