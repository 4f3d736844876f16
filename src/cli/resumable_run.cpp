// SPDX-License-Identifier: BSD-3-Clause
#include "resumable_run.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iterator>
#include <system_error>
#include <utility>

#include "interrupt.hpp"

namespace perimode::cli {

namespace {

/// Files the run reads are there, and not in the result that --force would replace.
void check_input(const std::filesystem::path& target, const std::filesystem::path& file) {
  if (std::error_code code; !std::filesystem::exists(file, code)) {
    invalid_input({fmt::format("the file {}", file.string()),
                   "none",
                   "a mode comes from `perimode modal`: run that first; paths are relative to the case file",
                   {}});
  }
  const auto inside =
      std::filesystem::weakly_canonical(file).lexically_relative(std::filesystem::weakly_canonical(target));
  if (inside.empty() || *inside.begin() == "..") return;
  invalid_input({"a result folder that holds no input of the case",
                 fmt::format("{} with {}", target.string(), inside.string()),
                 "choose another --output, or move the file",
                 {}});
}

/// What to remove when the run ends early, and what tells it from others.
std::string begin(const ResultDirectory& folder, const Case& input, const std::string& analysis,
                  bool resume) {
  set_unfinished_result(folder.unfinished(), resume ? "interrupted; the checkpoint is as it was"
                                                    : "interrupted; nothing was written");
  for (const std::filesystem::path& file : input.files) check_input(folder.target(), file);
  return case_digest(analysis, input.canonical, input.files);
}

}  // namespace

ResumableRun::ResumableRun(const Case& input, const Arguments& arguments, Kind kind, Console& console)
    : arguments_(&arguments),
      kind_(std::move(kind)),
      console_(&console),
      folder_(arguments.output.value_or(input.output.directory), arguments.force,
              arguments.resume ? Beginning::resumed : Beginning::new_run),
      digest_(begin(folder_, input, kind_.analysis, arguments.resume)),
      from_(arguments.resume ? read_checkpoint(folder_.temporary(), digest_, console.sink()) : std::nullopt),
      fields_(folder_.temporary() / "fields.exo",
              {input.title, kind_.analysis, input.output.fields, kind_.globals}, from_ ? from_->frames : 0) {
  if (from_) last_checkpoint_ = from_->state.step;
}

OutputFile& ResumableRun::text(const std::string& name, std::string_view header) {
  const std::filesystem::path path = folder_.temporary() / name;
  std::unique_ptr<OutputFile>& file = texts_[name];
  if (from_ && from_->bytes.contains(name)) {
    file = std::make_unique<OutputFile>(path, from_->bytes.at(name));
  } else {
    file = std::make_unique<OutputFile>(path);
    fmt::format_to(std::back_inserter(file->buffer()), "{}\n", header);
  }
  return *file;
}

void ResumableRun::save(const IntegratorState& state) {
  Checkpoint checkpoint{digest_, state, {}, fields_.frames()};
  for (const auto& [name, file] : texts_) {
    file->sync();
    checkpoint.bytes[name] = file->bytes();
  }
  fields_.sync();
  write_checkpoint(folder_.temporary(), checkpoint);
  folder_.keep();
  last_checkpoint_ = state.step;
}

bool ResumableRun::asked_to_stop() {
  if (!asks_) {
    interrupts_only_ask(
        fmt::format("interrupted at once; if there is a checkpoint, go on with: {}", resume_command()));
  }
  asks_ = true;
  if (seconds_since(shown_) >= 1.0) {
    for (const auto& [name, file] : texts_) file->show();
    shown_ = Clock::now();
  }
  return interrupt_requested();
}

std::string ResumableRun::resume_command() const {
  return arguments_->command_line + (arguments_->resume ? "" : " --resume");
}

int ResumableRun::end_interrupted(const std::string& where) {
  console_->clear_progress();
  console_->say(fmt::format("interrupted {}; go on with: {}", where, resume_command()));
  return 130;
}

void ResumableRun::fail(const Error& error) const {
  if (error.kind() != ErrorKind::environment || last_checkpoint_ < 0) throw error;
  throw Error(ErrorKind::environment,
              fmt::format("{}; the checkpoint of {} {} is whole: go on with: {}", error.what(), kind_.counted,
                          last_checkpoint_, resume_command()));
}

void ResumableRun::close() {
  for (const auto& [name, file] : texts_) file->close();
  fields_.close();
}

void ResumableRun::finish(const nlohmann::ordered_json& summary) {
  commit_summary(folder_, summary);
  remove_checkpoints(folder_.target());
}

}  // namespace perimode::cli
