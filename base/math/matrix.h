#pragma once
#ifdef __x86_64__
#include <immintrin.h>  // whole, before its switches are hidden
#endif

/// Eigen, restricted to two numbers at a time and no fused operations, on every processor. Without the restriction it takes the widest
/// available lanes, and the order of its sums and their last bits change with the lanes. Every file that needs Eigen includes this header,
/// so that one program holds one Eigen. tests/house/layers.py checks it. See docs/adr/0026-the-same-bits-at-every-level.md.
#pragma push_macro("__AVX__")
#pragma push_macro("__AVX2__")
#pragma push_macro("__FMA__")
#pragma push_macro("__AVX512F__")
#pragma push_macro("__AVX512DQ__")
#pragma push_macro("__AVX512ER__")
#undef __AVX__
#undef __AVX2__
#undef __FMA__
#undef __AVX512F__
#undef __AVX512DQ__
#undef __AVX512ER__
#include <Eigen/Dense>
#pragma pop_macro("__AVX__")
#pragma pop_macro("__AVX2__")
#pragma pop_macro("__FMA__")
#pragma pop_macro("__AVX512F__")
#pragma pop_macro("__AVX512DQ__")
#pragma pop_macro("__AVX512ER__")
