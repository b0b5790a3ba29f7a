#pragma once

/// What has this is compiled for each kind of processor, and the one that is there takes its own;
/// the sanitizers' start comes too late for it.
#if defined(__x86_64__) && !defined(TOURMALINE_SANITIZED)
#define FOR_EACH_PROCESSOR [[gnu::target_clones("default", "avx2", "avx512f")]]
#else
#define FOR_EACH_PROCESSOR
#endif
