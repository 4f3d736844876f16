// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <vector>

#include "perimode/assembly/model.hpp"
#include "perimode/dispersion/wave_record.hpp"
#include "perimode/geometry/particles.hpp"

namespace perimode {

/// Calls `frame` with the time (s) and the displacements (point-major) of every step of the `fields.exo` in
/// the result folder of a transient run. Throws invalid_input, at `where`: a folder without that file, a file
/// that cannot be read, one without displacements, particles other than these (number, places to 1e-9 of
/// their extent). Holds one frame at a time.
template <int Dim>
void for_each_run_frame(const std::filesystem::path& folder, const Particles<Dim>& particles,
                        const Where& where, const std::function<void(double, const Eigen::VectorXd&)>& frame);

/// The plane waves on a path (`corners` in pi/spacing) in a transient run of the model, whose `fields.exo`
/// has steps at equal times (`fields_every`). A last step out of turn is left out: a run also writes the end
/// of its time. Throws invalid_input, at `where`: as for_each_run_frame and waves_on_path; a model that is no
/// full grid (a cloud, cells removed) or not periodic along every axis; fewer than 4 steps; unequal times.
template <int Dim>
[[nodiscard]] WaveRecorder<Dim> record_run(const std::filesystem::path& folder, const Model& model,
                                           const std::vector<Point<Dim>>& corners, const Where& where = {});

}  // namespace perimode
