// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "perimode/geometry/particles.hpp"

namespace perimode {

/// Particles as the points of an Exodus II file.
struct ExodusMesh {
  std::string title;              ///< cut to 80 bytes
  std::vector<std::string> info;  ///< lines about the run, each cut to 80 bytes
  std::vector<double> x, y, z;    ///< m; 1D and 2D bodies have zeros in y and z
  std::vector<int> block;         ///< index into block_names, one per particle
  std::vector<std::string> block_names = {
      ""};  ///< "" is written as "body"; blocks without particles are left out
};

template <int Dim>
[[nodiscard]] ExodusMesh exodus_mesh(const Particles<Dim>& particles);

/// Point-major vectors (x0 y0 x1 y1 ...) as three arrays x, y, z; missing components are zero.
[[nodiscard]] std::vector<std::vector<double>> three_components(std::span<const double> vectors,
                                                                int dimension);

/// One time step: values in the order of the names given to the writer.
struct ExodusStep {
  double time = 0.0;
  std::vector<double> globals;
  std::vector<std::vector<double>> nodal;  ///< [variable][particle]
};

/// Writes an Exodus II file (NetCDF classic, 64-bit offsets): a node and a SPHERE element per
/// particle, one element block per block. Variables named a_x, a_y, a_z show as one vector in ParaView.
/// Every function throws Error(environment) when the file cannot be written.
class ExodusWriter {
 public:
  ExodusWriter(const std::filesystem::path& file, const ExodusMesh& mesh,
               const std::vector<std::string>& global_names, const std::vector<std::string>& nodal_names);
  /// Goes on with a file this class has written, after its first `steps` steps; later ones are written over.
  /// Throws invalid_input for a file that holds fewer.
  ExodusWriter(const std::filesystem::path& file, int steps);
  ~ExodusWriter();
  ExodusWriter(ExodusWriter&& other) noexcept;
  ExodusWriter& operator=(ExodusWriter&&) = delete;
  ExodusWriter(const ExodusWriter&) = delete;
  ExodusWriter& operator=(const ExodusWriter&) = delete;

  /// Appends a step. @pre sizes agree with the names and the mesh.
  void write(const ExodusStep& step);
  /// All of it on the disk.
  void sync();
  /// Ends the file; to be called, since the destructor cannot report a full disk.
  void close();

 private:
  void check(int code, const char* what) const;
  void write_mesh(const ExodusMesh& mesh);
  void declare(int kind, const std::vector<std::string>& names);

  std::filesystem::path file_;
  int id_ = -1;  ///< of the open file; -1: closed
  int steps_ = 0;
};

}  // namespace perimode
