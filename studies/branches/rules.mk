# Branches: what begins at the checkpoints of isotropic compactions. Included by Makefile.studies, whose habits hold here.
#
# compactions.csv  name, grains' Young's modulus in MPa, fracture energy of the bonds in N/mm (0: no bonds), relative densities
#                  at which checkpoints are kept, further settings
# branches.csv     name, parent, programme (studies/branches/PROGRAMME.toml), settings: KEY=VALUE words of the scenario
#                  parent: compaction:NAME@DENSITY, branch:NAME (its last stage) or branch:NAME@STAGE
#
# out/MESH/compactions/NAME and out/MESH/branches/NAME hold run.h5, curve.csv and METRIC.json, made when something asks for
# them; their checkpoints stay in work/.

# Averaged nodal pressure halves the error of plain tets at the same mesh (docs/numerics.md). fig08 and fig09 keep plain tets,
# as the paper has them.
ELEMENT ?= tet4-anp
ifeq ($(filter $(ELEMENT),tet4 tet4-anp tet4-patch),)
  $(error ELEMENT=$(ELEMENT): allowed are tet4, tet4-anp and tet4-patch)
endif

# The paper's grains touch by their facets. SURFACE=smooth is nearer to round grains (docs/speed-against-error): stresses at a
# given density are an eighth lower at 0.03 mm.
SURFACE ?= facets
ifeq ($(filter $(SURFACE),facets smooth),)
  $(error SURFACE=$(SURFACE): allowed are facets and smooth)
endif

# ------------------------------------------------------------------------------------------------ the two tables
table_rows = $(shell awk -f studies/branches/rows.awk -v fields=$(2) $(1))
row_field = $(subst ;, ,$(patsubst -,,$(word $(2),$(subst |, ,$(1)))))

define compaction_row
compaction_names += $(call row_field,$(1),1)
compaction_$(call row_field,$(1),1)_modulus := $(call row_field,$(1),2)
compaction_$(call row_field,$(1),1)_energy := $(call row_field,$(1),3)
compaction_$(call row_field,$(1),1)_densities := $(call row_field,$(1),4)
compaction_$(call row_field,$(1),1)_settings := $(call row_field,$(1),5)
endef
define branch_row
branch_names += $(call row_field,$(1),1)
branch_$(call row_field,$(1),1)_parent := $(call row_field,$(1),2)
branch_$(call row_field,$(1),1)_programme := $(call row_field,$(1),3)
branch_$(call row_field,$(1),1)_settings := $(call row_field,$(1),4)
endef
$(foreach row,$(call table_rows,studies/branches/compactions.csv,5),$(eval $(call compaction_row,$(row))))
$(foreach row,$(call table_rows,studies/branches/branches.csv,4),$(eval $(call branch_row,$(row))))

compactions := $(out)/compactions
branches := $(out)/branches

# $(call compaction_assignments,NAME): element, contact surface, material and bonds, which a branch shares with its compaction.
compaction_assignments = element.type=$(ELEMENT) contact.surface=$(SURFACE) material.youngs_modulus=$(compaction_$(1)_modulus) \
  $(if $(filter-out 0,$(compaction_$(1)_energy)),bond.tensile_strength=25 bond.shear_strength=18 bond.fracture_energy=$(compaction_$(1)_energy)) \
  $(compaction_$(1)_settings)
empty :=
set_words = $(foreach word,$(1),--set '$(word)')
comma := ,
toml_list = [$(subst $(empty) $(empty),$(comma),$(strip $(1)))]

# Of a parent: its kind and name, the checkpoint's own name, and the run, checkpoint and compaction that it stands for.
parent_kind = $(firstword $(subst :, ,$(branch_$(1)_parent)))
parent_name = $(firstword $(subst @, ,$(word 2,$(subst :, ,$(branch_$(1)_parent)))))
parent_at = $(word 2,$(subst @, ,$(branch_$(1)_parent)))
last_stage = $(shell awk -f studies/branches/last-stage.awk studies/branches/$(branch_$(1)_programme).toml)
from_compaction = $(filter compaction,$(call parent_kind,$(1)))
parent_run = $(if $(call from_compaction,$(1)),$(compactions),$(branches))/$(call parent_name,$(1))/run.h5
parent_checkpoint = $(if $(call from_compaction,$(1)),$(compactions)/$(call parent_name,$(1))/work/run.D$(call parent_at,$(1)).checkpoint.h5,$(branches)/$(call parent_name,$(1))/work/run.$(or $(call parent_at,$(1)),$(call last_stage,$(call parent_name,$(1)))).checkpoint.h5)
branch_root = $(if $(call from_compaction,$(1)),$(call parent_name,$(1)),$(call branch_root,$(call parent_name,$(1))))

# Rows that cannot be meant.
define check_branch
$(if $(wildcard studies/branches/$(branch_$(1)_programme).toml),,$(error branches.csv: $(1): no programme studies/branches/$(branch_$(1)_programme).toml))
$(if $(filter $(call parent_name,$(1)),$(if $(call from_compaction,$(1)),$(compaction_names),$(branch_names))),,$(error branches.csv: $(1): there is no $(branch_$(1)_parent)))
$(if $(call from_compaction,$(1)),$(if $(filter $(call parent_at,$(1)),$(compaction_$(call parent_name,$(1))_densities)),,$(error branches.csv: $(1): compactions.csv keeps no checkpoint of $(call parent_name,$(1)) at $(call parent_at,$(1)))))
endef
$(foreach b,$(branch_names),$(call check_branch,$(b)))

# ------------------------------------------------------------------------------------------------ runs
# A run works in work/ and is moved out when it is complete; a rerun goes on from its own checkpoints, unless an input is newer
# than all that the run has made.
# $(call run_recipe,SCENARIO,OPTIONS)
define run_recipe
for input in $(filter-out FORCE,$^); do for own in $(@D)/work/run.checkpoint.h5 $(@D)/work/run.checkpoint.previous.h5 $(@D)/work/run.h5 $@; do [ ! $$own -nt $$input ] || continue 2; done; rm -f $(@D)/work/run.*h5*; done
$(RUN) $(BIN)/mpfem run $(1) -o $(@D)/work/run.h5 --set packing=$(mesh) $(2) --resume $(threads) > $(@D)/work/log.txt 2>&1 || \
  { code=$$?; tail -n 3 $(@D)/work/log.txt >&2; [ $$code != 5 ] || echo 'The same make command goes on where this run stopped.' >&2; exit $$code; }
mv $(@D)/work/run.h5 $@
endef

$(addsuffix /work,$(addprefix $(compactions)/,$(compaction_names)) $(addprefix $(branches)/,$(branch_names))):
	mkdir -p $@

# $(call compaction_rules,NAME)
define compaction_rules
$(call stamp,$(compactions)/$(1)/run.settings,packing $(packing) size $(size) $(call compaction_assignments,$(1)) checkpoints $(compaction_$(1)_densities) scenario $(call content_of,studies/branches/compaction.toml))
$(compactions)/$(1)/run.h5: $(mesh) $(compactions)/$(1)/run.settings | $(compactions)/$(1)/work $(BIN)/mpfem
	$$(call run_recipe,studies/branches/compaction.toml,$$(call set_words,$$(call compaction_assignments,$(1))) --set 'output.checkpoint_relative_densities=$$(call toml_list,$$(compaction_$(1)_densities))')
endef
$(foreach c,$(compaction_names),$(eval $(call compaction_rules,$(c))))

# $(call branch_rules,NAME)
define branch_rules
$(call stamp,$(branches)/$(1)/run.settings,from $(branch_$(1)_parent) $(call compaction_assignments,$(call branch_root,$(1))) $(branch_$(1)_settings) scenario $(branch_$(1)_programme) $(call content_of,studies/branches/$(branch_$(1)_programme).toml))
$(branches)/$(1)/run.h5: $(call parent_run,$(1)) $(branches)/$(1)/run.settings | $(branches)/$(1)/work $(BIN)/mpfem
	@[ -e $(call parent_checkpoint,$(1)) ] || { rm -f $$@; echo '$(call parent_checkpoint,$(1)) is missing; the same make command makes it again' >&2; exit 1; }
	$$(call run_recipe,studies/branches/$(branch_$(1)_programme).toml,--from $(call parent_checkpoint,$(1)) $$(call set_words,$$(call compaction_assignments,$(call branch_root,$(1))) $$(branch_$(1)_settings)))
endef
$(foreach b,$(branch_names),$(eval $(call branch_rules,$(b))))

# A run whose checkpoint is missing is made again, as far as it takes, for a branch that has not been made.
wants_parent_again = $(and $(wildcard $(call parent_run,$(1))),$(if $(wildcard $(branches)/$(1)/run.h5 $(call parent_checkpoint,$(1))),,again))
$(foreach b,$(branch_names),$(if $(call wants_parent_again,$(b)),$(eval $(call parent_run,$(b)): FORCE)))

# All runs, whether or not a figure asks for them.
.PHONY: branches
branches: $(branch_names:%=$(branches)/%/run.h5)

# ------------------------------------------------------------------------------------------------ numbers
$(compactions)/%/curve.csv: $(compactions)/%/run.h5 | $(BIN)/postproc
	$(BIN)/postproc curve $< --quiet -o $(@D)/new-curve.csv
	mv $(@D)/new-curve.csv $@

$(branches)/%/curve.csv: $(branches)/%/run.h5 | $(BIN)/postproc
	$(BIN)/postproc curve $< --quiet -o $(@D)/new-curve.csv
	mv $(@D)/new-curve.csv $@

metric_options_energy = --packing $(mesh)
# A sample sits down on its walls first and damage grows from the start: stricter rules leave no window (studies/fig12).
metric_options_modulus = --slope-change 0.15 --damage-share 0.5
define metric_rule
$(call stamp,$(branches)/$(1).settings,options $(metric_options_$(1)))
$(branches)/%/$(1).json: $(branches)/%/run.h5 studies/branches/measure.sh $(branches)/$(1).settings | $(BIN)/postproc
	sh studies/branches/measure.sh $(BIN)/postproc $(1) $$< $$@ $(metric_options_$(1))
endef
$(foreach m,elastic-recovery modulus strength yield hysteresis energy,$(eval $(call metric_rule,$(m))))

$(branches)/%/contact.json: $(branches)/%/run.h5 studies/branches/measure.sh | $(BIN)/postproc
	sh studies/branches/measure.sh $(BIN)/postproc contact $< $@ --history

# $(call branch_table,FILE,NAMES,COLUMNS): FILE holds a row for each of NAMES (g0.5-D0.92 ...), columns as gather.awk reads them.
branch_row_of = $(1);$(compaction_$(firstword $(subst -D, ,$(1)))_modulus);$(compaction_$(firstword $(subst -D, ,$(1)))_energy)
column_source = $(firstword $(subst ., ,$(lastword $(subst =, ,$(1)))))
define branch_table
$(1): studies/branches/gather.awk $(foreach n,$(2),$(foreach s,$(sort $(foreach c,$(3),$(call column_source,$(c)))),$(branches)/$(n)-$(s).json)) | $(patsubst %/,%,$(dir $(1)))
	awk -f $$< -v root=$(branches) -v rows='$(foreach n,$(2),$(call branch_row_of,$(n)))' -v columns='$(strip $(3))' > $$@.partial
	mv $$@.partial $$@
endef

# $(call fit_rule,NAME,TABLE,X,Y,MODELS,OPTIONS): TABLE.NAME.fits.json and .csv, what is fitted and its curves.
define fit_rule
$(basename $(2)).$(1).fits.json: studies/branches/fit.sh $(2) | $(BIN)/postproc
	sh $$< $(BIN)/postproc $(2) $$@ $(3) $(4) $(5) $(6)
endef

# $(call branch_quality,FOLDER,BRANCHES): FOLDER/quality.csv, how quasi-static their last stages are.
define branch_quality
$(1)/quality.csv: studies/common/verdict.awk studies/branches/quality.awk $(foreach b,$(sort $(2)),$(branches)/$(b)/curve.csv) | $(1)
	awk -f studies/common/verdict.awk -f studies/branches/quality.awk $(foreach b,$(sort $(2)),$(branches)/$(b)/curve.csv) > $$@.partial
	mv $$@.partial $$@
endef
