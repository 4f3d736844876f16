// SPDX-License-Identifier: BSD-3-Clause
#include "fields_file.hpp"

#include <utility>

#include "fields.hpp"
#include "perimode/core/version.hpp"

namespace perimode::cli {

FieldsFile::FieldsFile(std::filesystem::path file, Content content, std::int64_t frames)
    : file_(std::move(file)), content_(std::move(content)), frames_(frames) {
  if (frames_ > 0) writer_.emplace(file_, static_cast<int>(frames_));
}

template <int Dim>
void FieldsFile::add(double time, std::vector<double> globals, const Body<Dim>& body,
                     const Eigen::VectorXd& displacement, const Eigen::VectorXd* velocity) {
  Fields chosen = chosen_fields<Dim>(body, displacement, velocity, content_.fields);
  if (!writer_) {
    ExodusMesh mesh = exodus_mesh(body.particles);
    mesh.title = content_.title;
    mesh.info.push_back("perimode " + version() + ", " + content_.analysis + " analysis");
    writer_.emplace(file_, mesh, content_.globals, chosen.names);
  }
  writer_->write({time, std::move(globals), std::move(chosen.values)});
  ++frames_;
}

void FieldsFile::sync() {
  if (writer_) writer_->sync();
}

void FieldsFile::close() {
  if (writer_) writer_->close();
}

template void FieldsFile::add<1>(double, std::vector<double>, const Body<1>&, const Eigen::VectorXd&,
                                 const Eigen::VectorXd*);
template void FieldsFile::add<2>(double, std::vector<double>, const Body<2>&, const Eigen::VectorXd&,
                                 const Eigen::VectorXd*);
template void FieldsFile::add<3>(double, std::vector<double>, const Body<3>&, const Eigen::VectorXd&,
                                 const Eigen::VectorXd*);

}  // namespace perimode::cli
