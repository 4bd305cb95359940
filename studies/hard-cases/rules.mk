#: hard-cases       cases that break codes of this kind: too large steps, slivers, impact, a million steps (use -j2)
# hard-cases: cases that break codes of this kind. It uses its own packings and the small one, whatever MESH says. Every
# case is a run of one thread, so use -j.
hard := $(out)/hard-cases
# A case in one word, NAME|PACKING|SCENARIO|FROM|LINE, the line without spaces and quotes: for its settings.
hard_lines := $(shell awk -F, 'NR > 1 { line = $$0; gsub(/ /, "~", line); gsub(/"/, "", line); \
  print $$1 "|" $$3 "|" $$4 "|" ($$6 == "" ? "-" : $$6) "|" line }' studies/hard-cases/cases.csv)
# $(call hard_field,WORD,NUMBER)
hard_field = $(word $(2),$(subst |, ,$(1)))
hard_cases := $(foreach c,$(hard_lines),$(call hard_field,$(c),1))
# Where the run begins, if not at a packing: the case that leaves the checkpoint.
hard_from = $(patsubst %,$(hard)/work/%.csv,$(firstword $(subst ., ,$(filter-out -,$(call hard_field,$(1),4)))))
hard_packing = $(if $(filter smoke,$(1)),$(small_mesh),$(hard)/work/$(1).packing.h5)

hard-cases: $(addprefix $(hard)/,summary.csv still.csv fourteen.csv verdict.json)
.PHONY: hard-cases
$(hard)/work:
	mkdir -p $@

hard_box_eight := 0.284,0.284,0.284
hard_box_eight-slivers := $(hard_box_eight)
hard_box_fourteen := 3,3,3
hard_box_pair := 0.3,0.3,0.43
hard_box_gap := 0.56,0.3,0.321
hard_mesh_eight := --size 0.03
hard_mesh_eight-slivers := --size 0.03 --no-optimise
hard_mesh_fourteen := --size 0.1
hard_mesh_pair := --size 0.03
hard_mesh_gap := --size 0.03
hard_packings := eight eight-slivers fourteen pair gap
hard_packing_text = box $(hard_box_$(1)) mesh $(hard_mesh_$(1))
$(foreach p,$(hard_packings),$(eval \
  $(call stamp,$(hard)/work/$(p).packing.settings,$(call hard_packing_text,$(p)))))

$(hard)/work/eight-slivers.packing.h5: studies/hard-cases/eight.csv
$(foreach p,$(filter-out eight-slivers,$(hard_packings)),$(eval \
  $(hard)/work/$(p).packing.h5: studies/hard-cases/$(p).csv))
$(hard)/work/%.packing.h5: $(hard)/work/%.packing.settings | $(hard)/work $(BIN)/pack-gen
	$(BIN)/pack-gen import $(filter %.csv,$^) --box $(hard_box_$*) --quiet -o $(@D)/new-$*.spheres.h5
	$(BIN)/pack-gen mesh $(@D)/new-$*.spheres.h5 $(hard_mesh_$*) $(threads) --quiet -o $(@D)/new-$*.packing.h5
	rm -f $(@D)/new-$*.spheres.h5
	mv $(@D)/new-$*.packing.h5 $@

hard_scenarios := $(sort $(foreach c,$(hard_lines),$(call hard_field,$(c),3)))
$(foreach s,$(hard_scenarios),$(eval hard_content_$(s) := $(call content_of,studies/hard-cases/$(s).toml)))

# $(call hard_case_rules,NAME,PACKING,SCENARIO,LINE,WHAT IT BEGINS AT)
define hard_case_rules
$(call stamp,$(hard)/work/$(1).settings,$(4) $(hard_content_$(3)))

$(hard)/work/$(1).csv: $(hard)/work/$(1).settings $(call hard_packing,$(2)) $(5) \
  | $(hard)/work $(BIN)/mpfem $(BIN)/postproc
	$(RUN) sh studies/hard-cases/run-case.sh $(1) $(abspath $(call hard_packing,$(2))) $$(@D) $(BIN)
endef
# $(call hard_case,WORD): the rules of that case.
hard_case = $(call hard_case_rules,$(call hard_field,$(1),1),$(call hard_field,$(1),2),$(call hard_field,$(1),3), \
  $(call hard_field,$(1),5),$(call hard_from,$(1)))
$(foreach c,$(hard_lines),$(eval $(call hard_case,$(c))))

$(hard)/summary.csv: studies/hard-cases/gather.sh studies/hard-cases/row.awk studies/hard-cases/cases.csv \
  $(foreach c,$(hard_cases),$(hard)/work/$(c).csv)
	sh $< $(hard)/work $(hard_cases) > $@.partial
	mv $@.partial $@

$(hard)/still.csv: studies/hard-cases/still.awk $(hard)/work/still.csv
	awk -f studies/common/verdict.awk -f $^ > $@.partial
	mv $@.partial $@

$(hard)/fourteen.csv: studies/hard-cases/stress-strain.awk $(hard)/work/fourteen.csv
	awk -f studies/common/verdict.awk -f $^ > $@.partial
	mv $@.partial $@

$(hard)/verdict.json: studies/common/verdict.awk studies/hard-cases/verdict.awk $(hard)/summary.csv $(hard)/still.csv
	awk -f studies/common/verdict.awk -f studies/hard-cases/verdict.awk $(hard)/summary.csv $(hard)/still.csv > $@.partial
	mv $@.partial $@
