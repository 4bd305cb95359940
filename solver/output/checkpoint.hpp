#pragma once
// The complete state of a run on disk. A resumed run goes on bitwise as if nothing had happened.

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

  /// What stands among the fields of a checkpoint; the rest has datasets of its own.
  template <class Self, class Visitor>
  static void for_each_field(Self& s, Visitor&& visit) {
    visit("record.rows_in_stage", s.rows_in_stage), visit("record.snapshots_passed", s.snapshots_passed);
    visit("record.checkpoints_passed", s.checkpoints_passed), visit("record.wall_time", s.wall_time);
    visit("record.profile_seconds", s.profile_seconds);
  }
};

/// What a checkpoint is made of, after an advance() and before the next evaluate_forces().
struct CheckpointState {
  const Model& model;
  const Contact& contact;
  const WallFriction& wall_friction;
  const Tools& tools;
  const Grips& grips;
  const GrainSteps& grain_steps;
  FieldValues fields; ///< of the simulation, whose first whole number is the step, then of the record
};

/// Collective; of what is not of grains, the first rank's counts. Written beside and renamed, the same whatever the
/// ranks. Throws StorageError on the first rank, where the others may wait for it (gathered_file.hpp).
void write_checkpoint(const std::string& path, const CheckpointState& state, const RunRecord& record,
                      const std::string& scenario_text, const Communicator& ranks = Communicator());

/// An open checkpoint; every rank opens it. Every function throws InputError where the file is damaged.
class CheckpointReader {
public:
  explicit CheckpointReader(const std::string& path);

  const std::string& path() const { return file_.path(); }
  /// What tells its content from others.
  std::string content_hash() const;
  std::string scenario_text() const;
  std::string packing_hash() const;
  std::string from() const; ///< where the run began; empty: not known
  std::int64_t step() const;
  /// Whether a bond has formed by then.
  bool has_bonds() const;

  /// Collective. Throws InputError where the checkpoint belongs to another mesh or was written by a build whose arrays
  /// stand otherwise.
  void check_model(const Model& model, const Communicator& ranks = Communicator()) const;

  RunRecord record() const; ///< without what stands among the fields
  FieldValues fields() const;
  /// Replaces the state of nodes, tets and contact points of own grains: `contact` has the pairs whose first grain is
  /// an own one afterwards. No more than that is held, and no rank waits for another. Bonds keep the laws by which they
  /// formed; whether they resist sliding is said by `bond_parameters`, of the run that wrote the checkpoint; none where
  /// no bond has formed. The last law in `contact` stays that of bonds to come. `grips`: of a stage that grips, its
  /// axis set, or none. Friction that is on only now begins without anchors; anchors of friction that is off now are
  /// left out.
  void take_arrays(Model& model, Contact& contact, WallFriction& wall_friction, Tools& tools, GrainSteps& grain_steps,
                   Grips* grips, const std::optional<BondParameters>& bond_parameters) const;

private:
  schema::FileReader file_;
};

/// Throws InputError: numbers of a checkpoint that do not belong together.
[[noreturn]] void refuse_damaged_checkpoint(const std::string& path);

/// Reads all arrays of a checkpoint. Throws InputError where they do not match its checksum or cannot be read.
void verify_checkpoint(const std::string& path);

/// What tells a checkpoint's state from others. Throws InputError where the file is no checkpoint.
std::string checkpoint_checksum(const std::string& path);

} // namespace mpfem
