#include "solver/output/checkpoint.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/one_line.hpp"
#include "results-schema/descriptors.hpp"
#include "solver/output/checkpoint_datasets.hpp"
#include "solver/output/history.hpp"
#include "solver/output/numbering_hash.hpp"

namespace mpfem {

namespace check = schema::checkpoint;
namespace rows = checkpoint_datasets;

CheckpointReader::CheckpointReader(const std::string& path) : file_(path, schema::FileKind::checkpoint) {}

void refuse_damaged_checkpoint(const std::string& path) {
  throw InputError(fmt::format("{}: the checkpoint is damaged: its contents are inconsistent", one_line(path)));
}

std::string CheckpointReader::content_hash() const {
  if (file_.checksums().empty())
    throw InputError(fmt::format("{}: the checkpoint has no checksum, allowed: a file written by this version of mpfem",
                                 one_line(path())));
  return file_.checksums();
}

std::string CheckpointReader::scenario_text() const {
  return file_.read_scalar(check::scenario);
}

std::string CheckpointReader::packing_hash() const {
  return file_.read_scalar(check::packing_hash);
}

std::string CheckpointReader::from() const {
  return file_.has(check::run_from) ? file_.read_scalar(check::run_from) : "";
}

std::int64_t CheckpointReader::step() const {
  const auto integers = file_.read(check::run_integers);
  if (integers.empty()) refuse_damaged_checkpoint(path());
  return integers.front();
}

bool CheckpointReader::has_bonds() const {
  if (!file_.has(check::bond_facet)) return false;
  bool found = false;
  file_.read_in_pieces(check::bond_facet, [&](std::size_t, std::span<const std::int32_t> piece) {
    found = found || std::any_of(piece.begin(), piece.end(), [](std::int32_t f) { return f >= 0; });
  });
  if (found) return true;
  // Bonds that broke and have not formed again leave only what they dissipated.
  file_.read_in_pieces(check::bond_values, [&](std::size_t, std::span<const double> piece) {
    for (; !piece.empty(); piece = piece.subspan(rows::width<rows::Row>))
      found = found || rows::bond_of(-1, 0, piece.first(rows::width<rows::Row>)).dissipated_before > 0;
  });
  return found;
}

void CheckpointReader::check_model(const Model& model, const Communicator& ranks) const {
  const std::string numbering = hash_text(numbering_hash(ranks, model)); // before any rank fails
  const auto fail = [&](const std::string& what) {
    throw InputError(fmt::format("{}: the checkpoint {}", one_line(path()), what));
  };
  if (packing_hash() != hash_text(model.mesh_hash)) fail("belongs to another packing than the scenario's");
  // Arrays are in the order of nodes and tets, which may differ between versions.
  if (file_.read_scalar(check::numbering_hash) != numbering)
    fail("was written by a version of mpfem that orders nodes and tetrahedra differently");
  if (const auto lanes = file_.read_scalar(check::lanes); lanes != native_lanes)
    fail(fmt::format("was written by a build that computes {} tetrahedra at once, this one computes {}: results would "
                     "not be identical",
                     lanes, native_lanes));
  // Otherwise all contacts would open or close at once by the height of the smooth surface.
  if (const auto smooth = file_.read_scalar(check::smooth_grains); smooth != model.smooth_grains)
    fail(fmt::format(
        "has {} of {} grains with smooth contact surfaces, the scenario has {}, allowed: the same contact.surface",
        smooth, model.grains, model.smooth_grains));
}

RunRecord CheckpointReader::record() const {
  RunRecord record;
  try {
    record.history = unflatten(file_.read(check::run_history));
    if (file_.has(check::run_tool_history)) record.tool_history = tool_rows_of(file_.read(check::run_tool_history));
  } catch (const std::length_error&) {
    throw InputError(fmt::format("{}: the checkpoint was written by a version of mpfem with other history columns",
                                 one_line(path())));
  }
  record.snapshot_files = file_.read(check::run_snapshots);
  const auto name = file_.read(check::run_stage_name), end = file_.read(check::run_stage_end);
  const auto values = file_.read(check::run_stage_values),
             hold_root_mean_square = file_.read(check::run_stage_hold_rms);
  if (end.size() != name.size() || values.size() != 3 * name.size() || hold_root_mean_square.size() != name.size())
    refuse_damaged_checkpoint(path());
  for (std::size_t i = 0; i < name.size(); ++i)
    record.stages.push_back(
        {name[i], end[i], values[3 * i], values[3 * i + 1], values[3 * i + 2], hold_root_mean_square[i]});
  record.from = from();
  return record;
}

FieldValues CheckpointReader::fields() const {
  if (!file_.has(check::run_field_names))
    throw InputError(fmt::format("{}: the checkpoint was written by another version of mpfem", one_line(path())));
  return {.name = file_.read(check::run_field_names),
          .number = file_.read(check::run_numbers),
          .integer = file_.read(check::run_integers)};
}

std::string checkpoint_checksum(const std::string& path) {
  return CheckpointReader(path).content_hash();
}

bool holds_something_else(const std::string& path) {
  return schema::is_other_file(path, schema::FileKind::checkpoint);
}

void verify_checkpoint(const std::string& path) {
  const schema::FileReader file(path, schema::FileKind::checkpoint);
  file.verify();
}

} // namespace mpfem
