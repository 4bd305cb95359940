#pragma once
// The complete state of a run on disk. A resumed run continues bitwise as if nothing had happened.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/fields.hpp"
#include "results-schema/file.hpp"
#include "solver/boundary/grips.hpp"
#include "solver/boundary/tools.hpp"
#include "solver/boundary/wall_friction.hpp"
#include "solver/kernels/contact_forces.hpp"
#include "solver/kernels/node_motion.hpp"
#include "solver/model/grain_steps.hpp"
#include "solver/model/model.hpp"
#include "solver/output/history_row.hpp"
#include "solver/output/profile_parts.hpp"
#include "solver/output/stage_result.hpp"
#include "solver/output/tool_history.hpp"

namespace mpfem {

/// What a run carries besides the simulation.
struct RunRecord {
  std::vector<HistoryRow> history;
  std::vector<ToolRow> tool_history; ///< of all tools for each row of the history
  std::vector<std::string> snapshot_files;
  std::vector<StageResult> stages;   ///< those that are complete
  std::string from;                  ///< where the run began: checksum of a checkpoint, "packing", or empty: not known
  std::int64_t rows_in_stage = 0;    ///< history rows written in this stage
  std::int64_t snapshots_passed = 0; ///< relative densities of output.snapshot_relative_densities already passed
  std::int64_t checkpoints_passed = 0; ///< the same of output.checkpoint_relative_densities
  double wall_time = 0;                ///< s, of all parts of the run so far
  std::array<double, profile_parts> profile_seconds{};

  /// The part that is stored among the fields of a checkpoint; the rest has its own datasets.
  template <class Self, class Visitor>
  static void for_each_field(Self& s, Visitor&& visit) {
    visit("record.rows_in_stage", s.rows_in_stage), visit("record.snapshots_passed", s.snapshots_passed);
    visit("record.checkpoints_passed", s.checkpoints_passed), visit("record.wall_time", s.wall_time);
    visit("record.profile_seconds", s.profile_seconds);
  }
};

/// The content of a checkpoint, after an advance() and before the next evaluate_forces().
struct CheckpointState {
  const Model& model;
  const Contact& contact;
  const WallFriction& wall_friction;
  const Tools& tools;
  const Grips& grips;
  const GrainSteps& grain_steps;
  FieldValues fields; ///< of the simulation, whose first whole number is the step, then of the record
};

/// Collective; what does not belong to grains is taken from the first rank. The file is written under another name and
/// renamed; it does not depend on the number of ranks. Throws StorageError on all ranks if the first cannot write
/// (gathered_file.hpp).
void write_checkpoint(const std::string& path, const CheckpointState& state, const RunRecord& record,
                      const std::string& scenario_text, const Communicator& ranks = Communicator());

/// An open checkpoint; every rank opens it. Every function throws InputError if the file is damaged.
class CheckpointReader {
public:
  explicit CheckpointReader(const std::string& path);

  const std::string& path() const { return file_.path(); }
  /// A hash that identifies its content.
  std::string content_hash() const;
  std::string scenario_text() const;
  std::string packing_hash() const;
  std::string from() const; ///< where the run began; empty: not known
  std::int64_t step() const;
  /// Whether a bond has formed by then.
  bool has_bonds() const;

  /// Collective. Throws InputError if the checkpoint belongs to another mesh or was written by a build with another
  /// order of arrays.
  void check_model(const Model& model, const Communicator& ranks = Communicator()) const;

  RunRecord record() const; ///< without the part stored among the fields
  FieldValues fields() const;
  /// Replaces the state of nodes, tets and contact points of own grains. Afterwards `contact` has the pairs whose first
  /// grain is an own one. No more than that is held, and no rank waits for another. Bonds keep the laws by which they
  /// formed. `bond_parameters`, from the run that wrote the checkpoint, says whether bonds resist sliding; none if no
  /// bond has formed. The last law in `contact` stays that of future bonds. `grips`: of a stage that grips, its axis
  /// set, or none. Friction that is newly on begins without anchors; anchors of friction that is now off are left out.
  void take_arrays(Model& model, Contact& contact, WallFriction& wall_friction, Tools& tools, GrainSteps& grain_steps,
                   Grips* grips, const std::optional<BondParameters>& bond_parameters) const;

private:
  schema::FileReader file_;
};

/// Throws InputError: the numbers of the checkpoint are inconsistent.
[[noreturn]] void refuse_damaged_checkpoint(const std::string& path);

/// Reads all arrays of a checkpoint. Throws InputError if they do not match its checksum or cannot be read.
void verify_checkpoint(const std::string& path);

/// Whether a file is there that is not empty and no checkpoint. A damaged one counts as a checkpoint.
bool holds_something_else(const std::string& path);

/// A checksum that identifies a checkpoint's state. Throws InputError if the file is no checkpoint.
std::string checkpoint_checksum(const std::string& path);

} // namespace mpfem
