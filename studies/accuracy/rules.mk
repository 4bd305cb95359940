#: accuracy         speed against error: docs/speed-against-error (40 minutes of processor time with any MESH)
# Speed against error: the error of each setting and what it costs. Included by Makefile.studies, whose conventions
# apply here. Independent of MESH: cases.csv says what is run, case.awk what a row means.
#
# out/accuracy/meshes/KIND-FINENESS.h5, out/accuracy/work/CASE.* (run, curve, values), out/accuracy/*.csv; pictures,
# tables and the page are written to docs/speed-against-error.

accuracy := out/accuracy
accuracy_page := docs/speed-against-error
# default: some 40 minutes of processor time. friction adds the scenes with friction (7 minutes), paper finer meshes
# of 329 grains up to the paper's (an hour), large all others.
ACCURACY_SETS ?= default
.PHONY: accuracy

# There are about a hundred cases: their rules are read only if one of them is requested.
ifneq ($(filter accuracy $(accuracy)/% $(accuracy_page)/%,$(MAKECMDGOALS)),)

accuracy_rows := $(shell awk -f studies/accuracy/case.awk -v sets='$(ACCURACY_SETS)' studies/accuracy/cases.csv)
ifeq ($(accuracy_rows),)
  $(error ACCURACY_SETS=$(ACCURACY_SETS): studies/accuracy/cases.csv has no such case)
endif
accuracy_field = $(word $(2),$(subst |, ,$(1)))
accuracy_cases := $(foreach row,$(accuracy_rows),$(call accuracy_field,$(row),1))
accuracy_scenarios := $(addprefix accuracy/,sphere-elastic sphere-plastic sphere-confined pair recovery)
accuracy_scenarios += fig04/hemispheres compaction/compaction
# Scenes with friction are not in scenarios but in headers, which tests share.
accuracy_rubbed := $(foreach row,$(accuracy_rows),$(if $(filter %.hpp,$(call accuracy_field,$(row),4)),$(row)))
accuracy_headers := $(sort $(foreach row,$(accuracy_rubbed),$(call accuracy_field,$(row),4)))
$(foreach s,$(accuracy_scenarios:%=studies/%.toml) $(accuracy_headers),$(eval content_$(s) := $(call content_of,$(s))))

$(accuracy)/meshes $(accuracy)/work $(accuracy_page):
	mkdir -p $@

# ------------------------------------------------------------------------------------------------ meshes
# Spheres of the packings are made by their own rules, which belong to another MESH.
accuracy_spheres = out/packings/$(if $(filter small-%,$*),smoke,full)/spheres.h5
accuracy_make_spheres = [ -e $(accuracy_spheres) ] || \
  $(MAKE) --no-print-directory -f Makefile.studies MESH=$(if $(filter small-%,$*),smoke,coarse) $(accuracy_spheres)
$(accuracy)/meshes/%.h5: studies/accuracy/mesh.sh | $(accuracy)/meshes $(BIN)/pack-gen
	+$(if $(filter small-% full-%,$*),$(accuracy_make_spheres))
	$(RUN) sh $< $(BIN)/pack-gen "$$(echo $* | sed 's/-[^-]*$$//')" "$$(echo $* | sed 's/.*-//')" $(@D)/new-$*.h5
	mv $(@D)/new-$*.h5 $@

# ------------------------------------------------------------------------------------------------ runs
# Runs are short and use one thread unless THREADS says otherwise, so use -j. $(call accuracy_run,NAME,SCENARIO,OPTIONS)
define accuracy_run
for input in $^; do [ $(@D)/new-$(1).checkpoint.h5 -nt $$input ] || \
  rm -f $(@D)/new-$(1).checkpoint.h5 $(@D)/$(1).seconds; done
$(RUN) sh studies/accuracy/run.sh $(@D)/$(1).seconds $(BIN)/mpfem run $(2) -o $(@D)/new-$(1).h5 \
  --set packing=$(firstword $(filter $(accuracy)/meshes/%,$^)) \
  $(3) --threads $(or $(THREADS),1) --quiet --resume > $(@D)/$(1).log 2>&1 || \
  { code=$$?; tail -n 3 $(@D)/$(1).log >&2; [ $$code != 5 ] || $(same_command_again); exit $$code; }
endef

# $(call accuracy_rules,CASE,SCENE,MESH,SCENARIO,OPTIONS,RECOVERY): a run leaves new-CASE.compaction.checkpoint.h5 to
# the unloading.
define accuracy_rules
$(call stamp,$(accuracy)/work/$(1).settings,$(5) scenario $(content_$(4)))
$(accuracy)/work/$(1).h5: $(accuracy)/meshes/$(3).h5 $(accuracy)/work/$(1).settings | $(accuracy)/work $(BIN)/mpfem
	$$(call accuracy_run,$(1),$(4),$(call set_words,$(subst ;, ,$(5))))
	$(if $(filter -,$(6)),rm -f $$(@D)/new-$(1).*.checkpoint.h5)
	mv $$(@D)/new-$(1).h5 $$@

$(accuracy)/work/$(1).values.csv: studies/common/verdict.awk studies/accuracy/values.awk \
  $(accuracy)/work/$(1).curve.csv $(if $(filter -,$(6)),,$(accuracy)/work/$(1).recovery.curve.csv)
	awk $$(addprefix -f ,$$(filter %.awk,$$^)) -v scene=$(2) $$(filter %.csv,$$^) > $$@.partial
	mv $$@.partial $$@
endef
define accuracy_recovery_rules
$(call stamp,$(accuracy)/work/$(1).recovery.settings,$(6) scenario $(content_studies/accuracy/recovery.toml))
$(accuracy)/work/$(1).recovery.h5: $(accuracy)/meshes/$(3).h5 $(accuracy)/work/$(1).h5 \
  $(accuracy)/work/$(1).recovery.settings | $(BIN)/mpfem
	$$(call accuracy_run,$(1).recovery,studies/accuracy/recovery.toml,--from \
	  $$(@D)/new-$(1).compaction.checkpoint.h5 $(call set_words,$(subst ;, ,$(6))))
	rm -f $$(@D)/new-$(1).recovery.*.checkpoint.h5
	mv $$(@D)/new-$(1).recovery.h5 $$@
endef
# $(call accuracy_apply,RULES,ROW) by way of $(call accuracy_give,RULES,FIELDS)
accuracy_give = $(call $(1),$(word 1,$(2)),$(word 2,$(2)),$(word 3,$(2)),$(word 4,$(2)),$(word 5,$(2)),$(word 6,$(2)))
accuracy_apply = $(call accuracy_give,$(1),$(subst |, ,$(2)))
$(foreach row,$(filter-out $(accuracy_rubbed),$(accuracy_rows)),$(eval $(call accuracy_apply,accuracy_rules,$(row))))
accuracy_recovered := $(foreach row,$(accuracy_rows),$(if $(filter -,$(call accuracy_field,$(row),6)),,$(row)))
$(foreach row,$(accuracy_recovered),$(eval $(call accuracy_apply,accuracy_recovery_rules,$(row))))

# The program prints at once what summaries and values of other scenes are made from. It runs minutes at most and begins
# anew when it was interrupted.
$(BIN)/friction-accuracy: tests/benchmarks/friction_accuracy.cpp $(accuracy_headers)
	cmake --build $(BIN)/.. --target $(@F)
define accuracy_friction_rules
$(call stamp,$(accuracy)/work/$(1).settings,$(5) scenario $(content_$(4)))
$(accuracy)/work/$(1).summary.csv: $(accuracy)/work/$(1).settings | $(accuracy)/work $(BIN)/friction-accuracy
	rm -f $$(@D)/$(1).seconds
	$$(RUN) sh studies/accuracy/run.sh $$(@D)/$(1).seconds $$(BIN)/friction-accuracy $(subst ;, ,$(5)) > $$@.partial
	mv $$@.partial $$@

$(accuracy)/work/$(1).values.csv: $(accuracy)/work/$(1).summary.csv
	cp $$< $$@.partial
	mv $$@.partial $$@
endef
$(foreach row,$(accuracy_rubbed),$(eval $(call accuracy_apply,accuracy_friction_rules,$(row))))

$(accuracy)/work/%.curve.csv: $(accuracy)/work/%.h5 | $(BIN)/postproc
	$(BIN)/postproc curve $< --columns step,stage,relative_density,box_lengths,wall_stress,mean_stress --quiet \
	  -o $(@D)/new-$*.curve.csv
	mv $(@D)/new-$*.curve.csv $@

$(accuracy)/work/%.summary.csv: $(accuracy)/work/%.h5 | $(BIN)/postproc
	$(BIN)/postproc summary $< --quiet -o $(@D)/new-$*.summary.csv
	mv $(@D)/new-$*.summary.csv $@
# ------------------------------------------------------------------------------------------------ numbers
# kept.csv: what the sets gave that are not made by default; they give way to runs of this folder.
accuracy_kept := studies/accuracy/kept.csv
accuracy_values := $(accuracy_cases:%=$(accuracy)/work/%.values.csv)
accuracy_summaries := $(accuracy_cases:%=$(accuracy)/work/%.summary.csv)
accuracy_summaries += $(foreach row,$(accuracy_recovered),\
  $(accuracy)/work/$(call accuracy_field,$(row),1).recovery.summary.csv)
$(eval $(call stamp,$(accuracy)/cases.settings,$(accuracy_cases)))

$(accuracy)/runs.csv: studies/accuracy/runs.awk studies/accuracy/cases.csv $(accuracy_kept) \
  $(accuracy)/cases.settings $(accuracy_summaries)
	awk -f $< -v work=$(accuracy)/work -v cases='$(accuracy_cases)' $(wordlist 2,3,$^) > $@.partial
	mv $@.partial $@

$(accuracy)/values.csv: studies/accuracy/values-table.awk $(accuracy_kept) $(accuracy)/cases.settings $(accuracy_values)
	awk -f $< -v work=$(accuracy)/work -v cases='$(accuracy_cases)' $(accuracy_kept) > $@.partial
	mv $@.partial $@

$(accuracy)/references.csv: studies/common/verdict.awk studies/accuracy/references.awk \
  $(accuracy)/runs.csv $(accuracy)/values.csv studies/fig05/finite-elements.csv studies/fig04/cohesive.csv \
  tests/reference/die_transmission.csv studies/one-grain/limits.csv
	awk $(addprefix -f ,$(filter %.awk,$^)) $(filter %.csv,$^) > $@.partial
	mv $@.partial $@

$(accuracy)/points.csv: studies/common/verdict.awk studies/accuracy/points.awk studies/accuracy/cost.csv \
  $(accuracy)/references.csv $(accuracy)/runs.csv $(accuracy)/values.csv
	awk $(addprefix -f ,$(filter %.awk,$^)) $(filter %.csv,$^) > $@.partial
	mv $@.partial $@

# ------------------------------------------------------------------------------------------------------ pictures, page
# $(call accuracy_picture,NAME,SCENE,MEASURE,TITLE,NUMBERS)
define accuracy_picture
accuracy_pictures += $(1)
$(accuracy_page)/$(1).png $(accuracy_page)/$(1).svg: $(accuracy_page)/$(1).%: \
  studies/accuracy/plot.gp studies/accuracy/labels.awk studies/common/style.gp $(accuracy)/points.csv | \
  $(accuracy_page)
	$(gnuplot) -c $$< $$* $(accuracy)/points.csv $(2) $(3) '$(4)' '$(5)' $$@.partial
	mv $$@.partial $$@
endef
accuracy_pictures :=
$(eval $(call accuracy_picture,hertz,hertz,force,Elastic sphere between planes: force,R/h))
$(eval $(call accuracy_picture,flattened,flattened,force,Plastic sphere flattened between planes: force,R/h))
$(eval $(call accuracy_picture,confined,confined,axial-stress,Plastic sphere in a die: axial stress,R/h))
$(eval $(call accuracy_picture,pair,pair,force,Two plastic hemispheres: force,elements in the contact radius))
$(eval $(call accuracy_picture,pull-off,pull-off,pull-off,Two bonded elastic hemispheres: \
  force and pull-off,elements in the contact radius))
$(eval $(call accuracy_picture,mean-stress,small,mean-stress,Compaction of 25 grains: mean stress,element size / mm))
$(eval $(call accuracy_picture,recovery,small,recovery,Unloading of 25 grains: elastic recovery,element size / mm))
$(eval $(call accuracy_picture,modulus,small,modulus,Reloading of 25 grains: \
  Young modulus of the compact,element size / mm))
$(eval $(call accuracy_picture,full,full,mean-stress,Compaction of 329 grains: mean stress,element size / mm))
$(eval $(call accuracy_picture,full-recovery,full,recovery,Unloading of 329 grains: elastic recovery,element size / mm))
$(eval $(call accuracy_picture,full-modulus,full,modulus,Reloading of 329 grains: \
  Young modulus of the compact,element size / mm))
$(eval $(call accuracy_picture,partial-slip,partial-slip,shear-force,Two caps that slip: \
  shear force,elements in the contact radius))
$(eval $(call accuracy_picture,partial-slip-loss,partial-slip,loss,Two caps that slip: \
  loss per cycle,elements in the contact radius))
$(eval $(call accuracy_picture,die-column,die-column,transmission,Column that rubs in a die: transmission,R/h))

$(foreach p,locking packing,$(accuracy_page)/$(p).png $(accuracy_page)/$(p).svg): \
  studies/accuracy/plot-convergence.gp studies/common/style.gp \
  $(accuracy)/runs.csv $(accuracy)/values.csv $(accuracy)/references.csv | $(accuracy_page)
	$(gnuplot) -c $< $(patsubst .%,%,$(suffix $@)) $(basename $(@F)) $(filter %.csv,$^) $@.partial
	mv $@.partial $@

accuracy_kept_tables := points.csv values.csv references.csv
$(addprefix $(accuracy_page)/,$(accuracy_kept_tables)): $(accuracy_page)/%.csv: $(accuracy)/%.csv | $(accuracy_page)
	cp $< $@.partial
	mv $@.partial $@

$(accuracy_page)/README.md: studies/accuracy/page.sh studies/accuracy/page.md studies/accuracy/tables.awk \
  studies/common/verdict.awk $(accuracy)/points.csv $(accuracy)/values.csv $(accuracy)/references.csv | $(accuracy_page)
	sh $< $(filter %.csv,$^) > $@.partial
	mv $@.partial $@

accuracy: $(foreach p,$(accuracy_pictures) locking packing,$(accuracy_page)/$(p).png $(accuracy_page)/$(p).svg)
accuracy: $(addprefix $(accuracy_page)/,$(accuracy_kept_tables) README.md)

endif
