// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>

#include "io/output_file.hpp"
#include "perimode/core/error.hpp"
#include "perimode/io/matrix_market.hpp"
#include "perimode/io/table.hpp"
#include "unit/io/temporary_folder.hpp"

namespace perimode {
namespace {

using test::content;
using test::TemporaryFolder;

ErrorKind kind_of_failure(const std::function<void()>& write) {
  try {
    write();
  } catch (const Error& error) {
    return error.kind();
  }
  ADD_FAILURE() << "written without an error";
  return ErrorKind::invalid_input;
}

Csr small_matrix() {
  Csr matrix;
  matrix.rows = matrix.cols = 3;
  matrix.row_start = {0, 2, 5, 7};
  matrix.column = {0, 1, 0, 1, 2, 1, 2};
  matrix.value = {2.0 / 3.0, -1e-300, -1e-300, std::numbers::pi, 1e22, 1e22, 0.1};
  return matrix;
}

/// Reads coordinate form back: the sizes, then row, column (from 0) and value of every entry.
struct Entry {
  Index row, column;
  double value;
  bool operator==(const Entry&) const = default;
};
struct MatrixText {
  std::string header;
  Index rows = 0, cols = 0;
  std::vector<Entry> entries;
};
MatrixText read_back(const std::filesystem::path& file) {
  std::ifstream stream(file);
  MatrixText result;
  std::size_t count = 0;
  std::getline(stream, result.header);
  stream >> result.rows >> result.cols >> count;
  for (Entry e{}; stream >> e.row >> e.column >> e.value;)
    result.entries.push_back({e.row - 1, e.column - 1, e.value});
  EXPECT_EQ(result.entries.size(), count);
  return result;
}

TEST(WriteCsv, GivesSeventeenDigitsAndLeavesTheUnknownEmpty) {
  const TemporaryFolder folder;
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  write_csv(folder.path() / "a.csv", {{"mode", "kind", "frequency_hz"},
                                      {{Offset{1}, "elastic", 1.0 / 3.0}, {Offset{2}, "rigid", unknown}}});
  EXPECT_EQ(content(folder.path() / "a.csv"),
            "mode,kind,frequency_hz\n1,elastic,0.33333333333333331\n2,rigid,\n");
}

TEST(WriteCsv, QuotesTextThatHoldsCommasOrQuotes) {
  const TemporaryFolder folder;
  write_csv(folder.path() / "a.csv", {{"region"}, {{"face x-, \"left\""}}});
  EXPECT_EQ(content(folder.path() / "a.csv"), "region\n\"face x-, \"\"left\"\"\"\n");
}

TEST(WriteCsv, FullDiskAndMissingFolderAreErrorsOfTheEnvironment) {
  const Table table{{"a"}, {{1.0}}};
  EXPECT_EQ(kind_of_failure([&] { write_csv("/dev/full", table); }), ErrorKind::environment);
  EXPECT_EQ(kind_of_failure([&] { write_csv("/nowhere/a.csv", table); }), ErrorKind::environment);
}

TEST(WriteMatrixMarket, GeneralMatrixReadsBackToTheSameBits) {
  const TemporaryFolder folder;
  const Csr matrix = small_matrix();
  write_matrix_market(folder.path() / "K.mtx", matrix, MatrixSymmetry::general);
  const MatrixText back = read_back(folder.path() / "K.mtx");
  EXPECT_EQ(back.header, "%%MatrixMarket matrix coordinate real general");
  EXPECT_EQ(back.rows, 3);
  EXPECT_EQ(back.cols, 3);
  ASSERT_EQ(back.entries.size(), matrix.value.size());
  for (std::size_t e = 0; e < back.entries.size(); ++e) {
    EXPECT_EQ(back.entries[e].value, matrix.value[e]);
    EXPECT_EQ(back.entries[e].column, matrix.column[e]);
  }
}

TEST(WriteMatrixMarket, SymmetricMatrixIsItsLowerTriangle) {
  const TemporaryFolder folder;
  write_matrix_market(folder.path() / "K.mtx", small_matrix(), MatrixSymmetry::symmetric);
  const MatrixText back = read_back(folder.path() / "K.mtx");
  EXPECT_EQ(back.header, "%%MatrixMarket matrix coordinate real symmetric");
  EXPECT_THAT(back.entries,
              testing::ElementsAre(Entry{0, 0, 2.0 / 3.0}, Entry{1, 0, -1e-300},
                                   Entry{1, 1, std::numbers::pi}, Entry{2, 1, 1e22}, Entry{2, 2, 0.1}));
}

TEST(WriteMatrixMarket, MassIsADiagonalMatrix) {
  const TemporaryFolder folder;
  const std::vector<double> mass = {1.0, 0.5};
  write_matrix_market(folder.path() / "M.mtx", mass);
  const MatrixText back = read_back(folder.path() / "M.mtx");
  EXPECT_EQ(back.rows, 2);
  EXPECT_THAT(back.entries, testing::ElementsAre(Entry{0, 0, 1.0}, Entry{1, 1, 0.5}));
}

TEST(WriteMatrixMarket, FullDiskIsAnErrorOfTheEnvironment) {
  EXPECT_EQ(
      kind_of_failure([] { write_matrix_market("/dev/full", small_matrix(), MatrixSymmetry::general); }),
      ErrorKind::environment);
}

TEST(OutputFile, GoesOnAfterItsFirstBytes) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write("history.csv", "step\n1\n2\nhalf a li");
  {
    OutputFile output(file, 7);
    EXPECT_EQ(output.bytes(), 7);
    output.buffer().append(std::string_view("three\n"));
    EXPECT_EQ(output.bytes(), 13);
    output.sync();
    EXPECT_EQ(content(file), "step\n1\nthree\n");
    output.close();
  }
  EXPECT_EQ(kind_of_failure([&] { const OutputFile output(file, 100); }), ErrorKind::invalid_input);
  EXPECT_EQ(kind_of_failure([] { const OutputFile output("/nowhere/history.csv", 1); }),
            ErrorKind::environment);
}

}  // namespace
}  // namespace perimode
