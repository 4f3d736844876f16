// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/stopwatch.hpp"
#include "fracture/crack_run.hpp"
#include "perimode/core/error.hpp"

namespace perimode {

template <int Dim>
QuasistaticRow CrackRun<Dim>::row(double load_factor) const {
  QuasistaticRow row;
  row.event = result_.events + 1;
  row.load_factor = load_factor;
  ledger_.put(row);
  const double spread = problem_.direction.template lpNorm<1>();
  row.total_force = row.force * spread;
  row.mean_displacement = row.displacement / spread;
  row.broken_bonds = result_.broken_bonds;
  row.crack_length = options_->area.initial + broken_area_;
  return row;
}

template <int Dim>
void CrackRun<Dim>::start_row(const QuasistaticRow& row) {
  result_.events = label_ = row.event;
  if (row.event == 1) result_.first_load = row.load_factor;
  if (row.event == 1 || row.force > peak_force_) {
    peak_force_ = row.force;
    result_.peak_load = row.load_factor;
    result_.peak_event = row.event;
  }
  if (row.external_work != 0.0)
    result_.worst_balance = std::max(result_.worst_balance, std::abs(row.balance() / row.external_work));
  result_.last = row;
}

template <int Dim>
void CrackRun<Dim>::flush_broken() {
  if (unreported_.empty()) return;
  if (observer_->broken) observer_->broken(unreported_);
  unreported_.clear();
}

template <int Dim>
void CrackRun<Dim>::give_fields() {
  const auto start = Clock::now();
  if (observer_->fields) {
    observer_->fields(
        {result_.last.event,
         options_->control == QuasistaticControl::event ? result_.last.load_factor : result_.last.time,
         ledger_.state().displacement, body_});
  }
  frame_due_ = false;
  result_.seconds_output += seconds_since(start);
}

template <int Dim>
bool CrackRun<Dim>::end_row(const QuasistaticRow& row) {
  result_.last = row;
  const auto start = Clock::now();
  if (observer_->row) observer_->row(row);
  flush_broken();
  result_.seconds_output += seconds_since(start);
  frame_due_ = true;
  const auto due = [&](std::int64_t every) { return every > 0 && row.event % every == 0; };
  if (row.event == 1 || due(options_->fields_every)) give_fields();
  const bool stopped = observer_->stop && observer_->stop();
  if (stopped || due(options_->checkpoint_every)) {
    equilibrium_->rebuild();
    if (observer_->checkpoint) observer_->checkpoint(save());
  }
  return stopped;
}

template <int Dim>
QuasistaticResult CrackRun<Dim>::finish(QuasistaticStatus status, std::string message) {
  flush_broken();
  if (frame_due_ && status != QuasistaticStatus::interrupted) give_fields();
  result_.status = status;
  if (!message.empty()) result_.message = std::move(message);
  result_.ways = equilibrium_->totals();
  result_.factor_seconds = equilibrium_->solver().factor_seconds();
  result_.crack_length = options_->area.initial + broken_area_;
  result_.displacement = ledger_.state().displacement;
  return std::move(result_);
}

template <int Dim>
IntegratorState CrackRun<Dim>::save() const {
  IntegratorState state;
  state.step = result_.events;
  state.bits["alive"] = std::visit([](const auto& bonds) { return bonds.alive; }, body_->bonds);
  ledger_.save(state);
  const auto put = [&](const char* name) -> std::vector<double>& { return state.numbers[name]; };
  for (const Pin& pin : equilibrium_->pins()) put("pins").push_back(pin.dof);
  put("pins");
  put("removed").assign(removed_.begin(), removed_.end());
  put("guess").assign(q_.data(), q_.data() + q_.size());
  put("guess_columns") = {static_cast<double>(q_.cols())};
  for (const BondRef& bond : left_) {
    put("broken").push_back(bond.particle);
    put("broken").push_back(static_cast<double>(bond.slot));
  }
  put("broken");
  const QuasistaticResult& r = result_;
  const QuasistaticRow& last = r.last;
  put("run") = {spring_share_,          broken_area_,    peak_force_,
                r.first_load,           r.peak_load,     static_cast<double>(r.peak_event),
                r.worst_residual,       r.worst_balance, static_cast<double>(r.broken_bonds),
                frame_due_ ? 1.0 : 0.0, unit_energy_};
  put("last") = {last.time,
                 last.load_factor,
                 static_cast<double>(last.broken_bonds),
                 static_cast<double>(last.breaking_bonds),
                 last.crack_length,
                 static_cast<double>(last.iterations)};
  put("loose");
  for (const LoosePiece& piece : r.loose) {
    put("loose").insert(put("loose").end(), {static_cast<double>(piece.event),
                                             static_cast<double>(piece.particles), piece.loaded ? 1.0 : 0.0});
    put("loose").insert(put("loose").end(), piece.centre.begin(), piece.centre.end());
  }
  return state;
}

template <int Dim>
void CrackRun<Dim>::restore(const IntegratorState& state) {
  const auto take = [&](const char* name) -> const std::vector<double>& {
    const auto at = state.numbers.find(name);
    if (at == state.numbers.end()) {
      invalid_input({"a checkpoint of a quasi-static run",
                     fmt::format("one without '{}'", name),
                     "start the run anew",
                     {}});
    }
    return at->second;
  };
  const auto alive = state.bits.find("alive");
  std::visit(
      [&](auto& bonds) {
        if (alive == state.bits.end() || alive->second.size() != bonds.alive.size()) {
          invalid_input({fmt::format("{} words of alive bonds", bonds.alive.size()),
                         "others",
                         "resume the run with the case it was started with",
                         {}});
        }
        bonds.alive = alive->second;
      },
      body_->bonds);
  take("displacement");
  ledger_.restore(state);
  const std::vector<double>& removed = take("removed");
  for (std::size_t i = 0; i < removed_.size() && i < removed.size(); ++i) removed_[i] = removed[i] != 0.0;
  const std::vector<double>& guess = take("guess");
  const auto columns = static_cast<Eigen::Index>(take("guess_columns").at(0));
  q_ = Eigen::Map<const Eigen::MatrixXd>(guess.data(), body_->boundary.free, columns);
  const std::vector<double>& broken = take("broken");
  for (std::size_t b = 0; b + 1 < broken.size(); b += 2)
    left_.push_back({static_cast<Index>(broken[b]), static_cast<Offset>(broken[b + 1])});
  QuasistaticResult& r = result_;
  r.events = label_ = state.step;
  const std::vector<double>& run = take("run");
  spring_share_ = run.at(0);
  broken_area_ = run.at(1);
  peak_force_ = run.at(2);
  r.first_load = run.at(3);
  r.peak_load = run.at(4);
  r.peak_event = static_cast<std::int64_t>(run.at(5));
  r.worst_residual = run.at(6);
  r.worst_balance = run.at(7);
  r.broken_bonds = static_cast<Offset>(run.at(8));
  frame_due_ = run.at(9) != 0.0;
  unit_energy_ = run.at(10);
  const std::vector<double>& last = take("last");
  r.last.event = state.step;
  r.last.time = last.at(0);
  r.last.load_factor = last.at(1);
  r.last.broken_bonds = static_cast<Offset>(last.at(2));
  r.last.breaking_bonds = static_cast<Offset>(last.at(3));
  r.last.crack_length = last.at(4);
  r.last.iterations = static_cast<int>(last.at(5));
  ledger_.put(r.last);
  const std::vector<double>& loose = take("loose");
  for (std::size_t at = 0; at + 3 + Dim <= loose.size(); at += 3 + Dim) {
    r.loose.push_back({static_cast<std::int64_t>(loose[at]),
                       static_cast<Index>(loose[at + 1]),
                       {loose.begin() + static_cast<std::ptrdiff_t>(at) + 3,
                        loose.begin() + static_cast<std::ptrdiff_t>(at) + 3 + Dim},
                       loose[at + 2] != 0.0});
  }
}

#define PERIMODE_REPORT(D)                                                        \
  template QuasistaticRow CrackRun<D>::row(double) const;                         \
  template void CrackRun<D>::start_row(const QuasistaticRow&);                    \
  template bool CrackRun<D>::end_row(const QuasistaticRow&);                      \
  template void CrackRun<D>::flush_broken();                                      \
  template void CrackRun<D>::give_fields();                                       \
  template QuasistaticResult CrackRun<D>::finish(QuasistaticStatus, std::string); \
  template IntegratorState CrackRun<D>::save() const;                             \
  template void CrackRun<D>::restore(const IntegratorState&)
PERIMODE_REPORT(1);
PERIMODE_REPORT(2);
PERIMODE_REPORT(3);
#undef PERIMODE_REPORT

}  // namespace perimode
