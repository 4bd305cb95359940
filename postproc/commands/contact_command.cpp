// contact: all contacts of a snapshot, one in detail, or all through a run.

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/commands/command.hpp"
#include "postproc/commands/commands.hpp"
#include "postproc/drawing/contact_picture.hpp"
#include "postproc/files/notes.hpp"
#include "postproc/files/text_file.hpp"
#include "postproc/metrics/contact_history.hpp"
#include "postproc/run_data/contact.hpp"

namespace mpfem {

namespace {

class ContactCommand : public RunCommand {
public:
  explicit ContactCommand(CLI::App& app)
      : RunCommand(
            app, "contact",
            "Contacts between grains at a snapshot: force and area of every pair, with bonds also their area, damage "
            "and\n"
            "energies. With --pair one contact in detail: its force, areas, damage and bonds.\n"
            "Example: postproc contact run.h5 --snapshot -1 -o contacts.csv\n"
            "Example: postproc contact run.h5 --pair 3,17 -o contact.json --data bonds.csv --view damage.png\n"
            "Example: postproc contact run.h5 --history -o contacts.csv",
            "File to write, .json or .csv (default: CSV on standard output); with --pair JSON", csv_or_json_file) {
    CLI::App& command = options();
    add_snapshot(command, snapshot_);
    add_numbers(command, "--pair", pair_, 2, whole_numbers, "",
                "Two grains, separated by a comma: their contact in detail");
    command.add_flag("--history", history_,
                     "All contacts together through the run: areas, coordination, damage, one row per history row; "
                     "with -o FILE.json at the end of a stage");
    add_number(command, "--stage", stage_, whole_numbers, "",
               "With --history: stage as in the scenario, from 0; negative from the end (default: the last)");
    add_output("--data", data_, "With --pair: CSV file to write, one row per bond", csv_file);
    add_output("--view", view_, "With --pair: PNG file to write, damage in the contact's plane", png_file);
    add_drawing(command, picture_, "With --view: ", "the grains and the relative density", "the nodes' patches");
  }

private:
  void execute() const override {
    if (history_) {
      execute_through_run();
      return;
    }
    refuse_given({"--stage"}, "without --history", "with it");
    if (view_.empty()) refuse_given({"--mesh", "--title", "--pixels"}, "without --view", "with --pair and --view");
    if (!pair_.empty()) {
      execute_for_pair();
      return;
    }
    if (!data_.empty() || !view_.empty())
      throw InputError("--data and --view belong to one contact: found no --pair, allowed: --pair FIRST,SECOND");
    execute_for_all();
  }

  void execute_through_run() const {
    if (!pair_.empty()) throw InputError("found --pair and --history, allowed: one of them");
    refuse_given({"--snapshot", "--data", "--view", "--mesh", "--title", "--pixels"},
                 "together with --history, which is of all contacts and rows", "without it");
    const schema::FileReader file = open_run();
    Measurement end = measure_contact(file, stage_); // also refuses a missing stage
    note_unfinished(end, file);
    const bool as_json = output().ends_with(".json");
    deliver(as_json ? to_json(end).dump(2) + "\n" : csv_text(contact_history(HistoryTable(file))));
    if (quiet()) return;
    fmt::print(output().empty() ? stderr : stdout, "{}", to_text(end));
    print_notes(end.notes);
  }

  void execute_for_pair() const {
    if (output().ends_with(".csv"))
      throw InputError("-o with --pair: found a .csv file, allowed: .json; --data writes the points as CSV");
    const schema::FileReader file = open_run();
    const ContactMap map = contact_map(file, snapshot_, {pair_[0], pair_[1]});
    const std::string points = contact_points_csv(map);
    if (!view_.empty()) // first, because only it can still fail
      write_contact_picture(view_, read_snapshot(file, snapshot_), map, picture_);
    if (!data_.empty()) write_file(data_, points);
    deliver(to_json(map).dump(2) + "\n");
  }

  void execute_for_all() const {
    const ContactTable table = contact_table(open_run(), snapshot_);
    deliver(output().ends_with(".json") ? to_json(table).dump(1) + "\n" : csv_text(table.columns));
    if (!quiet())
      fmt::print(stderr,
                 "relative density {:.4f}, mean stress {:.4g} MPa: {} pairs that touch or were ever bonded "
                 "(coordination number {:.2f}), contact area over surface {:.4f}\n",
                 table.relative_density, table.mean_stress, table.columns.front().values.size(),
                 table.coordination_number, table.contact_area_ratio);
  }

  int snapshot_ = -1;
  std::vector<int> pair_;
  bool history_ = false;
  std::optional<int> stage_;
  std::string data_, view_;
  ContactPictureRequest picture_;
};

} // namespace

std::unique_ptr<Command> contact_command(CLI::App& app) {
  return std::make_unique<ContactCommand>(app);
}

} // namespace mpfem
