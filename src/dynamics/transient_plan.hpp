// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perimode/dynamics/transient.hpp"

namespace perimode {

/// Whether bonds may break.
[[nodiscard]] bool may_break(const TransientOptions& options);

/// Whether the run needs the forces of bonds that turn or break: explicit steps of them.
[[nodiscard]] bool needs_bond_forces(const TransientOptions& options);

/// Particles none of whose bonds break, ascending: those of no_fail, and those with bonds across a surface of
/// given traction, whose map counts on these bonds. Throws invalid_input for a region without particles.
template <int Dim>
[[nodiscard]] std::vector<Index> unbreakable(const Body<Dim>& body, const TransientOptions& options);

/// Throws what run_transient throws of options that do not fit each other or the body, before anything is
/// computed.
template <int Dim>
void check_options(const Body<Dim>& body, const TransientOptions& options);

/// Step, number of steps and the stable step where it is needed. Throws invalid_input as run_transient.
template <int Dim>
[[nodiscard]] TransientPlan plan_steps(const Body<Dim>& body, const TransientOptions& options,
                                       const Motion& motion);

/// Steps nearest to options.fields_at and those of fields_every, ascending; the last one where none is asked
/// for.
[[nodiscard]] std::vector<std::int64_t> field_steps(const TransientOptions& options,
                                                    const TransientPlan& plan);

}  // namespace perimode
