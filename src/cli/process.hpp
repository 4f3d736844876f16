// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace perimode::cli {

/// Starts the program once more, in place and under the same process id, when that is needed to set what must
/// be set before the libraries start their threads:
/// - SIGINT and SIGTERM are blocked in every thread, so that only the thread that waits for them takes them.
/// (METIS
///   installs a handler of its own for SIGTERM while it orders a matrix; a blocked signal never reaches it.)
/// - OpenBLAS gets the AVX-512 kernels where the processor has them but is too new for the library to know.
/// - Idle threads sleep instead of spinning.
/// Whatever the user's environment says about the latter two stands. Call first thing in main.
void prepare_process(char** argv);

}  // namespace perimode::cli
