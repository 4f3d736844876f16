// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace perimode::slepc_module {

/// A symmetric matrix in compressed rows, columns ascending.
struct Matrix {
  std::int32_t rows;
  const std::int64_t* row_start;
  const std::int32_t* column;
  const double* value;
};

/// Orthonormal vectors, one after the other.
struct Vectors {
  std::int32_t count;
  const double* value;
};

/// Takes a converged pair.
using TakePair = void (*)(void* context, double value, const double* vector);

/// What the module offers, in C's conventions so that it may be loaded on its own. Each function returns
/// null, or what went wrong (a text that lives until the next call). Not for two threads at a time.
struct Functions {
  /// The `count` eigenvalues nearest to `target` outside `deflated`; more or fewer where so many converged.
  const char* (*nearest)(const Matrix* a, const Vectors* deflated, std::int32_t count, double target,
                         double tolerance, TakePair take, void* context);
  /// All eigenvalues between two points, by spectrum slicing.
  const char* (*between)(const Matrix* a, double lower, double upper, double tolerance, TakePair take,
                         void* context);
  /// Number of eigenvalues below sigma, by the inertia of A - sigma I.
  const char* (*below)(const Matrix* a, double sigma, std::int64_t* count);
};

/// Name of the one function to look up: `const Functions* perimode_slepc_functions()`.
constexpr const char* entry_point = "perimode_slepc_functions";
using EntryPoint = const Functions* (*)();

}  // namespace perimode::slepc_module
