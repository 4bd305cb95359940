# How figures and studies are made from their TOML files (docs/figure-file.md): packing, mesh, runs, metrics, tables, fits,
# plots, verdicts, page. Included by Makefile.studies; installed under that name, it makes users' own studies anywhere.
#
# What is made from what is said by `postproc depends`, whose output is included as compilers' dependencies are. One
# principal output a rule, written as NAME.partial (or in a work folder) and renamed, so that nothing half written ever
# stands under its own name. Folders and executables are order-only: a rebuilt program does not make results old (`clean`
# does). Settings enter through stamps, files which are rewritten only when their content changes. Checkpoints are no
# targets: make deletes targets when it is interrupted.

ifeq ($(filter oneshell else-if,$(.FEATURES)),)
  $(error GNU Make 3.82 or newer is needed)
endif
MAKEFLAGS += --no-builtin-rules --no-builtin-variables
SHELL := /bin/sh
# Decimal points in every language.
unexport LC_ALL
export LC_NUMERIC := C
.SUFFIXES:
.DELETE_ON_ERROR:
# Meshes made on the way to a picture are kept: they take longest.
.SECONDARY:
.DEFAULT_GOAL := help
FORCE:
.PHONY: FORCE help study

# The toolkit's own files: this folder in the source tree, share/mpfem/studies where it is installed.
toolkit := $(patsubst %/,%,$(dir $(lastword $(MAKEFILE_LIST))))
studies := $(if $(wildcard $(toolkit)/branches),$(toolkit),$(toolkit)/studies)
makefile := $(firstword $(MAKEFILE_LIST))
ifeq ($(words $(MAKEFILE_LIST)),1)
help:
	@printf '%s\n' "make -f $(makefile) study STUDY=my.toml [MESH=NAME] [RUN=PREFIX] [THREADS=N] [SEEDS='2 3'] [-jN]" \
	  'makes all that my.toml declares, and a page of it. Examples: $(studies)/examples'
endif

# ------------------------------------------------------------------------------------------------ settings
MESH ?= coarse
RUN ?=
THREADS ?=
BIN ?= $(if $(wildcard $(toolkit)/../../bin/postproc),$(toolkit)/../../bin,build/bin)

meshes := smoke coarse intermediate medium paper
ifeq ($(filter $(MESH),$(meshes)),)
  $(error MESH=$(MESH): allowed are $(meshes))
endif

# Nominal element size in mm: the four of the paper's Fig. 7; smoke is its coarsest on a small packing.
size_smoke := 0.03
size_coarse := 0.03
size_intermediate := 0.025
size_medium := 0.015
size_paper := 0.0075

# Averaged nodal pressure halves the error of plain tets at the same mesh (docs/numerics.md).
ELEMENT ?= tet4-anp
ifeq ($(filter $(ELEMENT),tet4 tet4-anp tet4-patch),)
  $(error ELEMENT=$(ELEMENT): allowed are tet4, tet4-anp and tet4-patch)
endif

# The paper's grains touch by their facets. SURFACE=smooth is nearer to round grains (docs/speed-against-error): stresses at
# a given density are an eighth lower at 0.03 mm.
SURFACE ?= facets
ifeq ($(filter $(SURFACE),facets smooth),)
  $(error SURFACE=$(SURFACE): allowed are facets and smooth)
endif

# Other packings of the same description. SEEDS: the figures that show a spread are made for these seeds too, each in its own
# folder by a make of its own with SEED.
SEED ?=
SEEDS ?=
ifneq ($(shell echo '$(SEED) $(SEEDS)' | tr -d '0-9 '),)
  $(error SEEDS=$(SEEDS): allowed are whole numbers, e.g. SEEDS='2 3 4')
endif
ifneq ($(words $(sort $(SEEDS))),$(words $(SEEDS)))
  $(error SEEDS=$(SEEDS): a seed stands there twice)
endif
ifneq ($(filter-out 0,$(filter 0%,$(SEED) $(SEEDS))),)
  $(error SEEDS=$(SEED) $(SEEDS): a seed begins with 0)
endif
ifneq ($(and $(SEED),$(SEEDS)),)
  $(error SEED=$(SEED) SEEDS=$(SEEDS): allowed is one of both; SEEDS adds packings to the one of $(description))
endif

# ------------------------------------------------------------------------------------------------ which packing
# A study with a powder of its own has its own packing; all others share that of the figures.
STUDY ?=
study_name := $(patsubst %.toml,%,$(notdir $(patsubst %/figure.toml,%.toml,$(STUDY))))
of_powder := $(if $(STUDY),$(shell $(BIN)/postproc powder '$(STUDY)' --programmes $(studies)/branches | sed -n '1s/^# element_size = //p'))
ifneq ($(and $(filter study,$(MAKECMDGOALS)),$(if $(wildcard $(STUDY)),,missing)),)
  $(error STUDY=$(STUDY): expected the file of a study, e.g. make -f $(makefile) study STUDY=my.toml)
endif
packing_smoke := smoke
packing := $(or $(packing_$(MESH)),full)
ifneq ($(of_powder),)
  out := out/own$(SEED:%=-seed%)
  packings := $(out)/$(study_name)/packing
  description := $(out)/$(study_name)/powder.toml
  size := $(of_powder)
else
  out := out/$(MESH)$(SEED:%=-seed%)
  packings := out/packings/$(packing)$(SEED:%=-seed%)
  examples := $(or $(patsubst $(toolkit)/../%/mcc_ph102.toml,%,$(wildcard $(toolkit)/../pack-gen/examples/mcc_ph102.toml)),$(studies)/packings)
  description := $(examples)/$(if $(filter smoke,$(packing)),mcc_ph102_smoke,mcc_ph102).toml
  size := $(size_$(MESH))
endif
sizes ?= $(size)
spheres := $(packings)/spheres.h5
mesh := $(packings)/mesh-$(size).h5
threads := $(if $(THREADS),--threads $(THREADS))
own_seed = $(shell sed -n 's/^seed *= *\([0-9]*\).*/\1/p' $(description))
ifneq ($(and $(SEEDS),$(filter $(own_seed),$(SEEDS))),)
  $(error SEEDS=$(SEEDS): $(own_seed) is the seed of $(description) itself, which always takes part)
endif

# ------------------------------------------------------------------------------------------------ stamps
# $(call stamp,FILE,TEXT): FILE holds TEXT; it is old only if its content differs. Compared while this file is read, so
# that `make -n` tells the truth and writes nothing.
define stamp
$(1): $(if $(and $(wildcard $(1)),$(findstring |$(strip $(2))|,|$(strip $(file <$(1)))|)),,FORCE)
	mkdir -p $$(@D)
	printf '%s\n' '$(strip $(2))' > $$@.partial
	mv $$@.partial $$@
endef
content_of = $(firstword $(shell cat $(1) 2>/dev/null | sha256sum))

$(BIN)/pack-gen $(BIN)/mpfem $(BIN)/postproc:
	@echo 'Makefile.studies: $@ is not built; ./bootstrap build builds it' >&2; exit 1

# ------------------------------------------------------------------------------------------------ packings
ifneq ($(of_powder),)
content_of_description := $(firstword $(shell $(BIN)/postproc powder '$(STUDY)' --programmes $(studies)/branches | sha256sum))
$(description): $(packings)/spheres.settings | $(BIN)/postproc
	$(BIN)/postproc powder '$(STUDY)' --programmes $(studies)/branches -o $@
$(packings)/spheres.h5: $(description)
else
content_of_description := $(call content_of,$(description))
endif
$(eval $(call stamp,$(packings)/spheres.settings,$(description) $(content_of_description)$(SEED:%= seed %)))
$(foreach s,$(sizes),$(eval $(call stamp,$(packings)/mesh-$(s).settings,size $(s))))

$(packings)/spheres.h5: $(packings)/spheres.settings | $(BIN)/pack-gen
	mkdir -p $(@D)
	$(BIN)/pack-gen spheres $(description) $(SEED:%=--seed %) -o $(@D)/new-spheres.h5
	mv $(@D)/new-spheres.h5 $@

$(packings)/spheres.csv: $(packings)/spheres.h5 | $(BIN)/pack-gen
	$(BIN)/pack-gen export $< -o $(@D)/new-spheres.csv
	mv $(@D)/new-spheres.csv $@

$(packings)/mesh-%.h5: $(packings)/spheres.h5 $(packings)/mesh-%.settings | $(BIN)/pack-gen
	$(RUN) $(BIN)/pack-gen mesh $< --size $* $(threads) -o $(@D)/new-mesh-$*.h5
	mv $(@D)/new-mesh-$*.h5 $@

# ------------------------------------------------------------------------------------------------ what is declared
# Of all figures together, since they share runs; of a user's study alone.
declared_sources := $(or $(STUDY),$(wildcard $(studies)/fig*/figure.toml))
declared := $(out)/$(if $(STUDY),$(study_name)/study,figures).mk
of_mesh := --results $(out) --mesh $(MESH) --programmes $(studies)/branches
goals := $(or $(MAKECMDGOALS),help)
ifneq ($(filter-out help clean clean-figures,$(goals)),)
# postproc is no prerequisite: make -B -n, by which times.sh lists runs, would carry out its rule.
$(declared): FORCE
	@[ -x $(BIN)/postproc ] || { echo 'Makefile.studies: $(BIN)/postproc is not built; ./bootstrap build builds it' >&2; exit 1; }
	@mkdir -p $(@D)
	@$(BIN)/postproc depends $(declared_sources) $(of_mesh) --packing $(mesh) --set element.type=$(ELEMENT) --set contact.surface=$(SURFACE) -o $@
include $(declared)
endif

# A run works in work/ and is moved out when it is complete; a rerun goes on from its own checkpoint, unless an input is newer.
$(declared_runs): | $(BIN)/mpfem
	@mkdir -p $(@D)/work
	@$(if $(filter --from,$(options)),[ -e $(word 2,$(options)) ] || { echo '$(word 2,$(options)) is missing; remove $< to make it again' >&2; exit 1; })
	for input in $^; do [ $(@D)/work/run.checkpoint.h5 -nt $$input ] || [ $(@D)/work/run.h5 -nt $$input ] || rm -f $(@D)/work/run.*h5*; done
	$(RUN) $(BIN)/mpfem run $(programme) -o $(@D)/work/run.h5 --set packing=$(mesh) $(options) --resume $(threads) > $(@D)/work/log.txt 2>&1 || \
	  { code=$$?; tail -n 3 $(@D)/work/log.txt >&2; [ $$code != 5 ] || echo 'The same make command goes on where this run stopped.' >&2; exit $$code; }
	mv $(@D)/work/run.h5 $@

$(declared_runs:.h5=.settings) $(metric_settings):
	@mkdir -p $(@D)
	printf '%s\n' '$(settings)' > $@.partial
	mv $@.partial $@

# What cannot be measured leaves "value": null, so that the other runs of a figure still make it; the reason stands beside.
$(metric_files): %.json: | $(BIN)/postproc
	$(BIN)/postproc $(measure) --quiet -o $*.new.json 2> $*.refused || \
	  { code=$$?; cat $*.refused >&2; [ $$code = 2 ] || exit $$code; printf '{"value": null, "notes": ["see %s"]}\n' $*.refused > $*.new.json; }
	@[ -s $*.refused ] || rm -f $*.refused
	mv $*.new.json $@

$(table_files): | $(BIN)/postproc
	@mkdir -p $(@D)
	$(BIN)/postproc table $(figure) $(basename $(@F)) $(of_mesh) -o $@

$(fit_files): | $(BIN)/postproc
	$(BIN)/postproc fits $(figure) $(of_mesh) -o $@

$(plot_files): | $(BIN)/postproc
	$(BIN)/postproc plot $(figure) $(basename $(@F)) $(of_mesh) $(if $(filter $@,$(spread_plots)),$(if $(SEEDS),--packings $(words own $(SEEDS)))) -o $@

$(picture_files): | $(BIN)/postproc
	@mkdir -p $(@D)
	$(BIN)/postproc $(picture) -o $(@D)/new-$(@F)
	mv $(@D)/new-$(@F) $@

# Sections are drawn pixel by pixel; so are their SVGs.
$(traced_files): %.svg: $(studies)/common/picture-in-svg.sh %.png
	sh $^ > $@.partial
	mv $@.partial $@

$(verdict_files): | $(BIN)/postproc
	@mkdir -p $(@D)
	$(BIN)/postproc verdict $(figure) $(of_mesh) -o $@

# ------------------------------------------------------------------------------------------------ SEEDS: several packings
$(eval $(call stamp,$(out)/packings.settings,packings $(SEEDS)))
$(spread_plots): $(out)/packings.settings
$(spread_files): $(out)/%.spread.csv: $(out)/%.csv $(out)/packings.settings $(foreach s,$(SEEDS),$(out)-seed$(s)/%.csv)
	$(BIN)/postproc table $(figure) $(patsubst %.spread,%,$(basename $(@F))) $(of_mesh) --spread $(filter %.csv,$^) -o $@

# Only of what is requested, since the runs of a packing take long; one make for all tables of a seed, since two would make
# the same runs. Its tables are newer only if it made them anew.
wanted_figures := $(if $(SEEDS),$(if $(filter all report smoke study,$(goals)),$(declared_figures) $(other_figures_with_spread),$(filter $(declared_figures) $(other_figures_with_spread),$(goals))))
seed_tables = $(patsubst $(out)/%.spread.csv,$(out)-seed$(1)/%.csv,$(filter $(foreach f,$(wanted_figures),$(out)/$(f)/%),$(spread_files) $(other_spread_files)))
seeds_wanted := $(if $(wanted_figures),$(SEEDS))
.PHONY: $(seeds_wanted:%=seed-%)
$(seeds_wanted:%=seed-%): seed-%:
	+$(MAKE) --no-print-directory -f $(makefile) MESH=$(MESH) SEEDS= SEED=$* $(call seed_tables,$*)
define seed_rules
$(call seed_tables,$(1)): seed-$(1)
	@:
endef
$(foreach s,$(seeds_wanted),$(eval $(call seed_rules,$(s))))

# ------------------------------------------------------------------------------------------------ a user's study
study: $(out)/$(study_name)/index.html
	@echo 'study: $<'
$(out)/$(study_name)/index.html: $($(study_name)_files)
	$(BIN)/postproc report $(STUDY) --results $(out) --programmes $(studies)/branches --title '$(study_name)' -o $@
