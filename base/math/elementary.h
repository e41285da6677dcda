#pragma once
#include <sleef.h>

/// The functions that a formula may name beside sine and cosine (constraints/formula/sincos.h), with the same bits on every processor. They
/// are SLEEF's deterministic forms without fused operations (Shibata and Petrogalli, IEEE Trans. Parallel Distrib. Syst. 31, 2020). The C
/// library's functions choose their code by the processor and change between its versions. Error below 1 unit in the last place for normal
/// numbers. Domains and limits are those of the C library, but sinh and cosh are infinite from 709.8 on (there 710.5). Any thread.
/// Computation time and error beside the C library's: docs/adr/0020-fused-operations-are-written-out.md.
namespace reachlab::elementary {

inline double sin(double x) noexcept { return Sleef_cinz_sind1_u10purec(x); }  // where constraints/formula/sincos.h ends
inline double cos(double x) noexcept { return Sleef_cinz_cosd1_u10purec(x); }
inline double exp(double x) noexcept { return Sleef_cinz_expd1_u10purec(x); }
inline double log(double x) noexcept { return Sleef_cinz_logd1_u10purec(x); }
inline double pow(double x, double y) noexcept { return Sleef_cinz_powd1_u10purec(x, y); }
inline double tan(double x) noexcept { return Sleef_cinz_tand1_u10purec(x); }
inline double asin(double x) noexcept { return Sleef_cinz_asind1_u10purec(x); }
inline double acos(double x) noexcept { return Sleef_cinz_acosd1_u10purec(x); }
inline double atan(double x) noexcept { return Sleef_cinz_atand1_u10purec(x); }
inline double atan2(double y, double x) noexcept { return Sleef_cinz_atan2d1_u10purec(y, x); }
inline double sinh(double x) noexcept { return Sleef_cinz_sinhd1_u10purec(x); }
inline double cosh(double x) noexcept { return Sleef_cinz_coshd1_u10purec(x); }
inline double tanh(double x) noexcept { return Sleef_cinz_tanhd1_u10purec(x); }

}  // namespace reachlab::elementary
