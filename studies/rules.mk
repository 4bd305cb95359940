# How figures and studies are made from their TOML files (docs/figure-file.md): packing, mesh, runs, metrics, tables,
# fits, plots, verdicts, page. Included by Makefile.studies; installed under that name, it makes users' own studies
# anywhere.
#
# `postproc depends` writes which file is made from which; its output is included, as the dependencies that a compiler
# writes are. Every rule has one principal output, which is written as NAME.partial (or in a work folder) and then
# renamed, so that a file under its final name is always complete. Folders and executables are order-only: a rebuilt
# program does not make results old (`clean` removes them). Settings enter through stamps: files which are rewritten
# only when their content changes. Checkpoints are not targets, because make deletes targets when it is interrupted.

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

ifeq ($(wildcard $(lastword $(MAKEFILE_LIST))),)
  $(error $(strip $(MAKEFILE_LIST)): allowed: a path without spaces)
endif
# The toolkit's own files: this folder in the source tree, share/mpfem/studies where it is installed.
toolkit := $(patsubst %/,%,$(dir $(lastword $(MAKEFILE_LIST))))
studies := $(if $(wildcard $(toolkit)/branches),$(toolkit),$(toolkit)/studies)
makefile := $(firstword $(MAKEFILE_LIST))
source := $(patsubst %studies/,%,$(toolkit)/)

# What lines that begin with "#:" say, and the figures' titles.
help:
	@echo 'make -f $(makefile) TARGET [NAME=VALUE] [-jN]' && echo
	@for file in $(wildcard $(studies)/fig*/figure.toml); do \
	  printf '  %-16s %s\n' "$$(basename "$$(dirname $$file)")" "$$(sed -n '1s/^title = "\(.*\)"$$/\1/p' $$file)"; done
	@sed -n 's/^#: /  /p' $(MAKEFILE_LIST)
	@echo && echo 'The same command continues an interrupted run (Ctrl-C, SIGTERM, kill) from its checkpoint.' && \
	  echo 'make -n shows all commands. Results are written to out/MESH/, with another SURFACE or' && \
	  echo 'ELEMENT to out/MESH-SURFACE/, out/MESH-ELEMENT/; a study with its own powder has own instead of MESH.'

# -------------------------------------------------------------------------------- settings
# $(call allowed,NAME,VALUES): fails if NAME is not one of the values.
allowed = $(if $(and $(filter 1,$(words $($(1)))),$(filter $(2),$($(1)))),,$(error $(1)=$($(1)): allowed: one of $(2)))
# $(call others_than,CHARACTERS,NAME): the characters that the value of NAME, as given, has beside these (as tr knows
# them).
others_than = $(shell printf %s '$(subst ','\'',$(value $(2)))' | LC_ALL=C tr -d '$(1)')

empty :=
space := $(empty) $(empty)
comma := ,

#: MESH=NAME        nominal element size: smoke (0.03 mm, small packing), coarse (0.03 mm, the default),
#:                  intermediate (0.025 mm), medium (0.015 mm), paper (0.0075 mm): those of the paper's Fig. 7;
#:                  coarser (0.04 mm) for SURFACE=smooth, which needs no more; not fig04 and fig05
MESH ?= coarse
meshes := smoke coarser coarse intermediate medium paper
$(call allowed,MESH,$(meshes))
size_smoke := 0.03
size_coarser := 0.04
size_coarse := 0.03
size_intermediate := 0.025
size_medium := 0.015
size_paper := 0.0075

#: RUN=PREFIX       written before each command that takes long, e.g. RUN='srun -n1 -c8'
RUN ?=
#: THREADS=N        threads of each such command (default: all cores that it may use). With -jN up to N of them run at
#:                  once, each with its own memory; a run with MESH=paper needs about 8 GiB
THREADS ?=
ifneq ($(call others_than,0-9,THREADS)$(filter 0%,$(THREADS)),)
  $(error THREADS=$(value THREADS): allowed: a whole number from 1)
endif
#: BIN=FOLDER       folder of the executables (default: build/bin, or that of the installation)
BIN ?= $(if $(filter $(toolkit),$(studies)),$(source)build/bin,$(toolkit)/../../bin)
ifneq ($(words $(BIN)),1)
  $(error BIN=$(BIN): allowed: a path without spaces)
endif

#: ELEMENT=TYPE     element of the figures: tet4-anp (default; averaged nodal pressure halves the error at the same
#:                  mesh, docs/speed-against-error), tet4 (the paper's), tet4-patch
ELEMENT ?= tet4-anp
$(call allowed,ELEMENT,tet4 tet4-anp tet4-patch)

#: SURFACE=TYPE     contact surface of the figures: facets (default, the paper's) or smooth (closer to spheres:
#:                  stresses at a given density are an eighth lower at 0.03 mm, docs/speed-against-error)
SURFACE ?= facets
$(call allowed,SURFACE,facets smooth)

#: BESIDE=NAME      draw the results of these settings into the plots, dashed, instead of those that the figure's file
#:                  names, e.g. BESIDE=coarse-tet4: those of out/NAME, or the kept ones of studies/results/NAME
BESIDE ?=
ifneq ($(filter-out 0 1,$(words $(BESIDE))),)
  $(error BESIDE=$(BESIDE): allowed: one name, without spaces)
endif
ifneq ($(BESIDE),)
  beside_folder := $(firstword $(wildcard out/$(BESIDE) $(studies)/results/$(BESIDE)))
  $(if $(beside_folder),,$(error BESIDE=$(value BESIDE): neither out/$(value BESIDE) nor $(studies)/results/$(value \
    BESIDE) exists))
endif

#: SEEDS='2 3'      further packings of the same description, for figures that show a spread; each has its own folder
#:                  and is made by a separate make with SEED
SEED ?=
SEEDS ?=
ifneq ($(call others_than,0-9 ,SEED)$(call others_than,0-9 ,SEEDS),)
  $(error SEEDS=$(value SEED)$(value SEEDS): allowed: whole numbers, e.g. SEEDS='2 3 4')
endif
ifneq ($(filter-out 0 1,$(words $(SEED))),)
  $(error SEED=$(SEED): found several, allowed: one; SEEDS='$(SEED)' makes packings of several)
endif
ifneq ($(words $(sort $(SEEDS))),$(words $(SEEDS)))
  $(error SEEDS=$(SEEDS): found a seed twice, allowed: once)
endif
ifneq ($(filter-out 0,$(filter 0%,$(SEED) $(SEEDS))),)
  $(error SEEDS=$(SEED) $(SEEDS): found a seed that begins with 0, allowed: no leading 0)
endif
ifneq ($(and $(SEED),$(SEEDS)),)
  $(error SEED=$(SEED) SEEDS=$(SEEDS): allowed: one of them; SEEDS adds packings to that of $(description))
endif

# Results of other elements and surfaces than the default lie in folders of their own.
variant := $(MESH)$(patsubst %,-%,$(filter-out facets,$(SURFACE)) $(filter-out tet4-anp,$(ELEMENT)))
variant := $(subst $(space),,$(variant))

# Notes once: make starts again when it has written the rules, and calls itself for further packings.
said_already := $(if $(MAKE_RESTARTS)$(SEED),--quiet)

# -------------------------------------------------------------------------------- which packing
# A study with a powder of its own has its own packing; all others share that of the figures.
STUDY ?=
# Other characters mean something to make or to the shell.
ifneq ($(call others_than,A-Za-z0-9._/+\200-\377-,STUDY),)
  $(error STUDY=$(value STUDY): allowed: a path of letters, digits, '.', '_', '-', '+' and '/')
endif
# `study` needs one, and `clean` takes one.
ifneq ($(or $(filter study,$(MAKECMDGOALS)),$(and $(STUDY),$(filter clean,$(MAKECMDGOALS)))),)
ifeq ($(filter %.toml,$(wildcard $(STUDY))),)
  $(error STUDY=$(STUDY): allowed: the file of a study, e.g. make -f $(makefile) study STUDY=my.toml)
endif
endif
# Of the whole path, so that ./figure.toml has the name of its folder. The path may have spaces before STUDY.
study_path := $(abspath $(STUDY))
study_name := $(patsubst %.toml,%,$(notdir $(patsubst %/figure.toml,%.toml,$(lastword $(study_path)))))
# As seen from out/own/NAME, as from out/own-smooth/NAME.
powder = $(BIN)/postproc powder '$(STUDY)' --results out/own --programmes $(studies)/branches
of_powder := $(if $(STUDY),$(shell $(powder) | sed -n '1s/^# element_size = //p'))
packing_smoke := smoke
packing := $(or $(packing_$(MESH)),full)
ifneq ($(of_powder),)
  out := out/$(patsubst $(MESH)%,own%,$(variant))$(SEED:%=-seed%)
  ifneq ($(and $(filter command line environment,$(origin MESH)),$(if $(said_already),,first)),)
    $(info $(makefile): note: MESH=$(MESH) selects cases of $(STUDY), not its mesh: its [powder] has an element_size)
  endif
  packings := $(out)/$(study_name)/packing
  description := $(out)/$(study_name)/powder.toml
  size := $(of_powder)
else
  out := out/$(variant)$(SEED:%=-seed%)
  packings := out/packings/$(packing)$(SEED:%=-seed%)
  examples := $(if $(wildcard $(source)pack-gen/examples),$(source)pack-gen/examples,$(studies)/packings)
  description := $(examples)/$(if $(filter smoke,$(packing)),mcc_ph102_smoke,mcc_ph102).toml
  size := $(size_$(MESH))
endif
# Names of targets, and of folders in out/MESH that the toolkit's own figures use.
names_of_targets := FORCE help note-on-seeds quickstart smoke all report forecast keep clean clean-figures \
  animation bonding hard-cases contact-surface nodal-pressure accuracy
names_of_results := $(if $(of_powder),,compaction compactions branches packings \
  $(patsubst $(studies)/%/figure.toml,%,$(wildcard $(studies)/fig*/figure.toml)))
own_figure := $(abspath $(studies)/$(study_name)/figure.toml)
ifneq ($(and $(STUDY),$(filter $(names_of_targets) $(names_of_results),$(study_name)),$(filter-out \
    $(own_figure),$(lastword $(study_path)))),)
  $(error STUDY=$(STUDY): the toolkit itself has something called $(study_name), allowed: a study with another name; \
    rename its file or folder)
endif
mesh := $(packings)/mesh-$(size).h5
threads := $(if $(THREADS),--threads $(THREADS))
ifneq ($(SEEDS),)
  # The study's own description is a file only once its packing has been made. Without a seed pack-gen takes 1.
  own_seed := $(or $(shell $(if $(of_powder),$(powder),cat $(description)) | sed -n 's/^seed *= *\([0-9]*\).*/\1/p'),1)
  ifneq ($(filter $(own_seed),$(SEEDS)),)
    $(error SEEDS=$(SEEDS): $(own_seed) is the seed of $(or $(of_powder:%=$(STUDY)),$(description)) itself, which \
      always takes part)
  endif
endif

# -------------------------------------------------------------------------------- stamps
# $(call stamp,FILE,TEXT): FILE holds TEXT; it is old only if its content differs. Compared while this file is read, so
# that `make -n` is right and writes nothing.
define stamp
$(1): $(if $(and $(wildcard $(1)),$(findstring |$(strip $(2))|,|$(strip $(file <$(1)))|)),,FORCE)
	mkdir -p $$(@D)
	printf '%s\n' '$(strip $(2))' > $$@.partial
	mv $$@.partial $$@
endef
content_of = $(firstword $(shell cat $(1) 2>/dev/null | sha256sum))

$(BIN)/pack-gen $(BIN)/mpfem $(BIN)/postproc:
	@echo '$(makefile): $@ is not built; ./bootstrap build builds it' >&2; exit 1

# -------------------------------------------------------------------------------- packings
ifneq ($(of_powder),)
content_of_description := $(firstword $(shell $(powder) | sha256sum))
$(description): $(packings)/spheres.settings | $(BIN)/postproc
	rm -f $@ # no text replaces a TOML file
	$(powder) -o $@
$(packings)/spheres.h5: $(description)
else
content_of_description := $(call content_of,$(description))
endif
$(eval $(call stamp,$(packings)/spheres.settings,$(description) $(content_of_description)$(SEED:%= seed %)))

$(packings)/spheres.h5: $(packings)/spheres.settings | $(BIN)/pack-gen
	mkdir -p $(@D)
	$(BIN)/pack-gen spheres $(description) $(SEED:%=--seed %) -o $(@D)/new-spheres.h5
	mv $(@D)/new-spheres.h5 $@

# A mesh is as old as its spheres, so that one which was removed and made again for a branch makes no runs old.
$(packings)/mesh-%.h5: $(packings)/spheres.h5 | $(BIN)/pack-gen
	$(RUN) $(BIN)/pack-gen mesh $< --size $* $(threads) -o $(@D)/new-mesh-$*.h5
	touch -r $< $(@D)/new-mesh-$*.h5
	mv $(@D)/new-mesh-$*.h5 $@

# -------------------------------------------------------------------------------- what is declared
# Of all figures together, because they share runs, or of one study of a user.
declared_sources := $(or $(STUDY),$(wildcard $(studies)/fig*/figure.toml))
declared := $(out)/$(if $(STUDY),$(study_name)/study,figures).mk
# Two studies of one name would replace each other's results.
study_record := $(dir $(declared))study.path
recorded_study := $(if $(STUDY),$(shell path=$$(cat $(study_record) 2>/dev/null) && [ -e "$$path" ] && echo "$$path"))
ifneq ($(if $(recorded_study),$(filter-out |$(subst $(space),|,$(study_path)),|$(subst $(space),|,$(recorded_study)))),)
  $(error STUDY=$(STUDY): $(dir $(declared)) has the results of $(recorded_study), allowed: a study with another name; \
    rename its file or folder, or remove those results)
endif
of_mesh := --results $(out) --mesh $(MESH) --programmes $(studies)/branches
goals := $(or $(MAKECMDGOALS),help)
ifneq ($(filter-out help clean clean-figures,$(goals)),)
# postproc is not a prerequisite: make -B -n, with which times.sh lists runs, would execute its rule.
$(declared): FORCE
	@[ -x $(BIN)/postproc ] || \
	  { echo '$(makefile): $(BIN)/postproc is not built; ./bootstrap build builds it' >&2; exit 1; }
	@mkdir -p $(@D)
	@$(if $(STUDY),printf '%s\n' '$(subst ','\'',$(study_path))' > $(study_record))
	@$(BIN)/postproc depends $(declared_sources) $(of_mesh) --meshes $(subst $(space),$(comma),$(meshes)) \
	  --packing $(mesh) --description $(description) \
	  --set element.type=$(ELEMENT) --set contact.surface=$(SURFACE) $(said_already) -o $@
include $(declared)
endif

# A run is written in work/ and moved out when it is complete. A rerun continues from its own checkpoints, unless an
# input is newer than all files that the run has made.
own_files = $(@D)/work/run.checkpoint.h5 $(@D)/work/run.checkpoint.previous.h5 $(@D)/work/run.h5 $@
# `postproc depends` has parents made again that lack a checkpoint. If it is still missing, they end before it. The
# checkpoint lies in work/, the complete run a folder above.
parent_run = $(dir $(patsubst %/,%,$(dir $(word 2,$(options)))))run.h5
not_reached = echo '$(word 2,$(options)): $(parent_run) ends without it, allowed: a stage or density that it reaches'
lost = rm -f $@; echo '$(word 2,$(options)) is missing; repeat the same make command to make it again'
checkpoint_is_missing = $(if $(filter $(parent_run),$(parents_to_make)),$(not_reached),$(lost))
same_command_again = echo 'The same make command continues this run.' >&2
$(declared_runs): | $(BIN)/mpfem
	@mkdir -p $(@D)/work
	@$(if $(filter --from,$(options)),[ -e $(word 2,$(options)) ] || { $(checkpoint_is_missing) >&2; exit 1; })
	for input in $(filter-out FORCE,$^); do \
	  for own in $(own_files); do [ ! $$own -nt $$input ] || continue 2; done; rm -f $(@D)/work/run.*h5*; \
	done
	$(RUN) $(BIN)/mpfem run $(programme) -o $(@D)/work/run.h5 $(options) --resume $(threads) > $(@D)/work/log.txt 2>&1 || \
	  { code=$$?; tail -n 3 $(@D)/work/log.txt >&2; [ $$code != 5 ] || $(same_command_again); exit $$code; }
	mv $(@D)/work/run.h5 $@

$(declared_packings): | $(BIN)/pack-gen
	$(BIN)/pack-gen $(command) -o $(@D)/new-packing.h5
	mv $(@D)/new-packing.h5 $@

$(declared_runs:.h5=.settings) $(declared_packings:.h5=.settings) $(metric_commands):
	@mkdir -p $(@D)
	printf '%s\n' '$(settings)' > $@.partial
	mv $@.partial $@

# A metric that cannot be measured gets "value": null, so that the figure is still made from the other runs; the reason
# is in NAME.refused. A damaged file is no such reason: make ends.
$(metric_files): %.json: | $(BIN)/postproc
	@mkdir -p $(@D)
	$(BIN)/$(measure) --quiet -o $*.new.json 2> $*.refused || \
	  { code=$$?; cat $*.refused >&2; [ $$code = 2 ] || exit $$code; \
	    $(BIN)/postproc validate --quiet $(word 3,$(measure)) >&2 || exit 2; \
	    printf '{"value": null, "notes": ["see %s"]}\n' $*.refused > $*.new.json; }
	@[ -s $*.refused ] || rm -f $*.refused
	mv $*.new.json $@

# The script or command that a figure names, for files that no subcommand of postproc makes.
$(script_files): | $(BIN)/mpfem $(BIN)/postproc
	@mkdir -p $(@D)
	$(script)
	mv $@.partial $@

$(files_without_cases):
	@echo '$(makefile): $(figure) has no cases with MESH=$(MESH), allowed: $(its_meshes)' >&2; exit 1

$(table_files): | $(BIN)/postproc
	@mkdir -p $(@D)
	$(BIN)/postproc table $(figure) $(basename $(@F)) $(of_mesh) -o $@

$(fit_files): | $(BIN)/postproc
	$(BIN)/postproc fits $(figure) $(of_mesh) -o $@

$(eval $(call stamp,$(out)/beside.settings,beside $(BESIDE)))
# Figures of which the other results have nothing are drawn without them.
beside_of = $(if $(BESIDE),$(if $(wildcard $(beside_folder)/$(notdir $(@D))),--beside $(BESIDE)=$(beside_folder)))
tables_beside = $(wildcard $(beside_folder)/$(notdir $(patsubst %/,%,$(dir $(1))))/*.csv)
$(if $(BESIDE),$(foreach p,$(plot_files),$(eval $(p): $(call tables_beside,$(p)))))
$(plot_files): $(out)/beside.settings | $(BIN)/postproc
	$(BIN)/postproc plot $(figure) $(basename $(@F)) $(of_mesh) $(beside_of) \
	  $(if $(and $(SEEDS),$(filter $@,$(spread_plots))),--packings $(words own $(SEEDS))) -o $@

$(picture_files): | $(BIN)/postproc
	@mkdir -p $(@D)
	$(BIN)/postproc $(picture) -o $(@D)/new-$(@F)
	mv $(@D)/new-$(@F) $@

# Sections are drawn pixel by pixel; so are their SVGs.
$(traced_files): %.svg: $(studies)/common/picture-in-svg.sh %.png
	sh $(filter-out FORCE,$^) > $@.partial
	mv $@.partial $@

$(verdict_files): | $(BIN)/postproc
	@mkdir -p $(@D)
	$(BIN)/postproc verdict $(figure) $(of_mesh) -o $@

# -------------------------------------------------------------------------------- SEEDS: several packings
$(eval $(call stamp,$(out)/packings.settings,packings $(SEEDS)))
$(spread_plots): $(out)/packings.settings
$(spread_files): $(out)/%.spread.csv: $(out)/%.csv $(out)/packings.settings $(foreach s,$(SEEDS),$(out)-seed$(s)/%.csv)
	$(BIN)/postproc table $(figure) $(patsubst %.spread,%,$(basename $(@F))) $(of_mesh) --spread $(filter %.csv,$^) -o $@

# Only for the requested figures, because the runs of a packing take long. One make makes all tables of a seed, because
# two would make the same runs. Its tables are newer only if it has made them again.
all_wanted := $(filter all report smoke study,$(goals))
wanted_figures := $(if $(SEEDS),$(if $(all_wanted),$(declared_figures),$(filter $(declared_figures),$(goals))))
wanted_spreads := $(filter $(wanted_figures:%=$(out)/%/%),$(spread_files))
seed_tables = $(patsubst $(out)/%.spread.csv,$(out)-seed$(1)/%.csv,$(wanted_spreads))
seeds_wanted := $(if $(wanted_figures),$(SEEDS))
.PHONY: $(seeds_wanted:%=seed-%)
$(seeds_wanted:%=seed-%): seed-%:
	+$(MAKE) --no-print-directory -f $(makefile) MESH=$(MESH) SEEDS= SEED=$* $(call seed_tables,$*)
define seed_rules
$(call seed_tables,$(1)): seed-$(1)
	@:
endef
$(foreach s,$(seeds_wanted),$(eval $(call seed_rules,$(s))))

# A recipe, because the plots are known only once make has read its files again.
.PHONY: note-on-seeds
note-on-seeds:
	@echo '$(makefile): note: SEEDS=$(SEEDS) has no effect: no series has spread = true' >&2
without_spread := $(if $(wanted_figures),$(if $(filter $(wanted_figures:%=$(out)/%/%),$(spread_plots)),,note-on-seeds))
$(wanted_figures) $(if $(wanted_figures),$(all_wanted)): | $(without_spread)

# -------------------------------------------------------------------------------- a user's study
#: study STUDY=FILE a study of your own (docs/own-study.md), and a page of it
study: $(out)/$(study_name)/index.html
	@echo 'study: $<'
$(out)/$(study_name)/index.html: $(files_of/$(study_name))
	$(BIN)/postproc report $(STUDY) --results $(out) --programmes $(studies)/branches --title '$(study_name)' -o $@
