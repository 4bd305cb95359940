# fig17 to fig26: triaxial compression, yield and cycles. Included by Makefile.studies after rules.mk.
#
# Runs are those of branches.csv. Bonds soften by the law `energy` (runs energy-...); studies/fig18/README.md says why.

# $(call curves_of,BRANCH...)
curves_of = $(foreach b,$(1),$(branches)/$(b)/curve.csv)
verdict := studies/common/verdict.awk
plot_style := studies/common/style.gp
both_formats = $(foreach p,$(1),$(p).png $(p).svg)

# $(call plot_rule,PICTURE,SCRIPT,ARGUMENTS,DATA): PICTURE.png and .svg by gnuplot -c SCRIPT png|svg ARGUMENTS PICTURE.
define plot_rule
$(1).png $(1).svg: $(1).%: $(2) $(plot_style) $(4)
	$(gnuplot) -c $$< $$* $(3) $$@.partial
	mv $$@.partial $$@
endef
# $(call judge_rule,FIGURE,PROGRAMS,DATA): its verdict, by PROGRAMS and its own.
define judge_rule
$($(1))/verdict.json: $(verdict) $(2) studies/$(1)/verdict.awk $(3)
	awk -f $(verdict) $(addprefix -f ,$(2)) -f studies/$(1)/verdict.awk $(3) > $$@.partial
	mv $$@.partial $$@
endef
# $(call awk_rule,FILE,PROGRAMS,DATA): FILE by awk -f PROGRAMS DATA.
define awk_rule
$(1): $(2) $(3) | $(patsubst %/,%,$(dir $(1)))
	awk $(addprefix -f ,$(2)) $(3) > $$@.partial
	mv $$@.partial $$@
endef

fig17 := $(out)/fig17
fig18 := $(out)/fig18
fig19 := $(out)/fig19
fig20 := $(out)/fig20
fig21 := $(out)/fig21
fig22 := $(out)/fig22
fig23 := $(out)/fig23
fig24 := $(out)/fig24
fig25 := $(out)/fig25
fig26 := $(out)/fig26
triaxial_figures := fig17 fig18 fig19 fig20 fig21 fig22 fig23 fig24 fig25 fig26
branch_figures += $(triaxial_figures)
.PHONY: $(triaxial_figures)
$(addprefix $(out)/,$(triaxial_figures)):
	mkdir -p $@

# ------------------------------------------------------------------------------------------------ fig17: stress path
fig17_files := $(addprefix $(fig17)/,stress-path.csv $(call both_formats,stress-path) verdict.json)
fig17: $(fig17_files)
$(eval $(call awk_rule,$(fig17)/stress-path.csv,$(verdict) studies/branches/stress-path.awk,$(compactions)/energy-g0.5/curve.csv $(call curves_of,$(addprefix energy-g0.5-D0.92-,p60 p16 p8 p8-triaxial))))
$(eval $(call plot_rule,$(fig17)/stress-path,studies/fig17/plot.gp,$(fig17)/stress-path.csv,$(fig17)/stress-path.csv))
$(eval $(call judge_rule,fig17,,$(fig17)/stress-path.csv))

# ------------------------------------------------------------------------------------------------ fig18, fig20: triaxial tests
# Both laws where the answer depends on it; g0 has no bonds.
fig18_tests := $(foreach d,0.92 0.86 0.80 0.73,energy-g0.5-D$(d)-p8-triaxial) g0.5-D0.92-p8-triaxial g0.5-D0.80-p8-triaxial
fig20_tests := $(foreach g,energy-g0.5 energy-g0.2 energy-g0.1 energy-g0.05 energy-g0.02 g0 g0.5 g0.1,$(g)-D0.92-p8-triaxial)

define test_rules
$(1)_files := $(addprefix $($(1))/,tests.csv $(call both_formats,deviatoric-stress volumetric-strain) verdict.json)
$(1): $$($(1)_files)
$(call awk_rule,$($(1))/tests.csv,$(verdict) studies/branches/stage-curves.awk,$(call curves_of,$($(1)_tests)))

$(foreach p,deviatoric-stress volumetric-strain,
$(call plot_rule,$($(1))/$(p),studies/$(1)/plot.gp,$(p) $($(1))/tests.csv,$($(1))/tests.csv)
)
$(call judge_rule,$(1),studies/branches/triaxial.awk,$($(1))/tests.csv)
endef
$(eval $(call test_rules,fig18))
$(eval $(call test_rules,fig20))

# ------------------------------------------------------------------------------------------------ fig19: dissipation in fig18
fig19_files := $(addprefix $(fig19)/,$(call both_formats,damage plastic) verdict.json)
fig19: $(fig19_files)
$(foreach p,damage plastic,$(eval $(call plot_rule,$(fig19)/$(p),studies/fig19/plot.gp,$(p) $(fig18)/tests.csv,$(fig18)/tests.csv | $(fig19))))
$(eval $(call judge_rule,fig19,studies/branches/triaxial.awk,$(fig18)/tests.csv))
$(fig19)/verdict.json: | $(fig19)

# ------------------------------------------------------------------------------------------------ fig21: damage on the section
fig21_energies := 0.5 0.1
fig21_files := $(fig21_energies:%=$(fig21)/section-%.png) $(fig21_energies:%=$(fig21)/section-%.svg) $(fig21)/sections.csv $(fig21)/verdict.json
fig21: $(fig21_files)
damage_section := --axis x --position 0.5 --relative --field damage --range 0,0.5

$(fig21)/section-%.png: $(branches)/energy-g%-D0.92-p8-triaxial/run.h5 | $(fig21) $(BIN)/postproc
	$(BIN)/postproc section $< $(damage_section) --title 'G^c = $* N/mm, axial strain 0.15' -o $(@D)/new-section-$*.png
	mv $(@D)/new-section-$*.png $@

$(fig21)/section-%.csv: $(branches)/energy-g%-D0.92-p8-triaxial/run.h5 | $(fig21) $(BIN)/postproc
	$(BIN)/postproc section $< $(damage_section) --data $(@D)/new-section-$*.csv -o $(@D)/unused-section-$*.png
	rm -f $(@D)/unused-section-$*.png
	mv $(@D)/new-section-$*.csv $@

$(eval $(call awk_rule,$(fig21)/sections.csv,$(verdict) studies/fig21/section-mean.awk,$(fig21_energies:%=$(fig21)/section-%.csv)))
$(eval $(call judge_rule,fig21,,$(fig21)/sections.csv $(fig20)/tests.csv))

# ------------------------------------------------------------------------------------------------ fig22: strength surface
fig22_tests_smoke := $(foreach g,energy-g0.5 energy-g0.1 energy-g0.02 g0,$(foreach p,2 8 16,$(g)-D0.92-p$(p))) energy-g0.2-D0.92-p8 energy-g0.05-D0.92-p8
fig22_tests_full := $(foreach g,energy-g0.5 energy-g0.2 energy-g0.1 g0,$(foreach p,2 4 8 16,$(g)-D0.92-p$(p))) energy-g0.05-D0.92-p8 $(foreach p,2 8 16,energy-g0.02-D0.92-p$(p))
fig22_tests := $(fig22_tests_$(packing))
fig22_exponential_tests := $(foreach g,g0.5 g0.1 g0,$(foreach p,2 8 16,$(g)-D0.92-p$(p))) g0.2-D0.92-p8
fig22_pictures := surface confining-stress fracture-energy
fig22_files := $(foreach l,energy exponential,$(addprefix $(fig22)/$(l)-,points.csv fits.json $(call both_formats,$(fig22_pictures)))) $(fig22)/verdict.json
fig22: $(fig22_files)

# $(call surface_rules,LAW,TESTS)
define surface_rules
$(call branch_table,$(fig22)/$(1)-strength.csv,$(2),strength~[MPa]=triaxial/strength.value uncertainty~[MPa]=triaxial/strength.uncertainty axial_strain~[1]=triaxial/strength.axial_strain_at_strength)
$(call awk_rule,$(fig22)/$(1)-points.csv,studies/fig22/points.awk,$(fig22)/$(1)-strength.csv)

$(fig22)/$(1)-fits.json: $(fig22)/$(1)-points.csv | $(BIN)/postproc
	$(BIN)/postproc fit $$< --x p_c --z G_c --y q --model pc-gc-surface --quiet -o $$(@D)/new-$(1)-fits.json
	mv $$(@D)/new-$(1)-fits.json $$@

$(call awk_rule,$(fig22)/$(1)-surface.csv,studies/fig22/eq13.awk studies/fig22/surface.awk,$(fig22)/$(1)-fits.json)
$(call awk_rule,$(fig22)/$(1)-cuts.csv,studies/fig22/eq13.awk studies/fig22/cuts.awk,$(fig22)/$(1)-fits.json $(fig22)/$(1)-points.csv)
$(call plot_rule,$(fig22)/$(1)-surface,studies/fig22/plot-surface.gp,$(fig22)/$(1)-points.csv $(fig22)/$(1)-surface.csv,$(fig22)/$(1)-points.csv $(fig22)/$(1)-surface.csv)
$(foreach p,confining-stress fracture-energy,
$(call plot_rule,$(fig22)/$(1)-$(p),studies/fig22/plot-cuts.gp,$(p) $(fig22)/$(1)-points.csv $(fig22)/$(1)-cuts.csv,$(fig22)/$(1)-points.csv $(fig22)/$(1)-cuts.csv)
)
endef
$(eval $(call surface_rules,energy,$(fig22_tests)))
$(eval $(call surface_rules,exponential,$(fig22_exponential_tests)))
$(eval $(call judge_rule,fig22,,$(foreach l,energy exponential,$(fig22)/$(l)-fits.json $(fig22)/$(l)-points.csv)))

# ------------------------------------------------------------------------------------------------ fig23: probing
fig23_files := $(addprefix $(fig23)/,stress-path.csv dissipation.csv $(call both_formats,stress-path dissipation) verdict.json)
fig23: $(fig23_files)
$(eval $(call awk_rule,$(fig23)/stress-path.csv,$(verdict) studies/branches/stress-path.awk,$(compactions)/energy-g0.5/curve.csv $(call curves_of,energy-g0.5-D0.92-p60 energy-g0.5-D0.92-p60-probe90)))
$(eval $(call awk_rule,$(fig23)/dissipation.csv,$(verdict) studies/fig23/dissipation.awk,$(fig23)/stress-path.csv))
$(eval $(call awk_rule,$(fig23)/yield.csv,studies/fig23/yield.awk,$(fig23)/dissipation.csv))
$(eval $(call plot_rule,$(fig23)/stress-path,studies/fig23/plot-path.gp,$(fig23)/stress-path.csv $(fig23)/yield.csv,$(fig23)/stress-path.csv $(fig23)/yield.csv))
$(eval $(call plot_rule,$(fig23)/dissipation,studies/fig23/plot-dissipation.gp,$(fig23)/dissipation.csv $(fig23)/yield.csv,$(fig23)/dissipation.csv $(fig23)/yield.csv))
$(eval $(call judge_rule,fig23,,$(fig23)/dissipation.csv $(fig23)/yield.csv))

# ------------------------------------------------------------------------------------------------ fig24: yield surface
# Directions in degrees from the p axis, q upwards, in the order in which points are joined.
probes_smoke := 135 117 90 45 0 -45 -90 -117 -135
probes_full := 135 117 90 63 45 27 0 -45 -90 -117 -135
fig24_samples := $(foreach c,energy-g0.5 g0 g0.5,$(c)-D0.92-p60)
fig24_probes := $(foreach c,$(fig24_samples),$(foreach a,$(probes_$(packing)),$(c)-probe$(a)))
fig24_files := $(addprefix $(fig24)/,yield.csv $(call both_formats,yield-surface) verdict.json)
fig24: $(fig24_files)
$(fig24)/yield.csv: studies/fig24/yield.awk $(foreach p,$(fig24_probes),$(branches)/$(p)/yield.json) | $(fig24)
	awk -f $< $(foreach p,$(fig24_probes),$(branches)/$(p)/yield.json) > $@.partial
	mv $@.partial $@
$(eval $(call plot_rule,$(fig24)/yield-surface,studies/fig24/plot.gp,$(fig24)/yield.csv,$(fig24)/yield.csv))
$(eval $(call judge_rule,fig24,,$(fig24)/yield.csv))

# ------------------------------------------------------------------------------------------------ fig25, fig26: cycles
cyclic_samples := energy-g0.5 g0.5 g0
fig25_files := $(addprefix $(fig25)/,loops.csv cycles.csv $(call both_formats,cohesive exponential no-cohesion) verdict.json)
fig25: $(fig25_files)
$(eval $(call awk_rule,$(fig25)/loops.csv,$(verdict) studies/fig25/loops.awk,$(call curves_of,$(cyclic_samples:%=%-cycles))))
$(fig25)/%.cycles.csv: $(branches)/%-cycles/run.h5 | $(fig25) $(BIN)/postproc
	$(BIN)/postproc hysteresis $< --quiet --cycles $(@D)/new-$*.cycles.csv -o $(@D)/unused-$*.json
	rm -f $(@D)/unused-$*.json
	mv $(@D)/new-$*.cycles.csv $@
$(eval $(call awk_rule,$(fig25)/cycles.csv,$(verdict) studies/fig25/drift.awk,$(cyclic_samples:%=$(fig25)/%.cycles.csv)))
$(eval $(call plot_rule,$(fig25)/cohesive,studies/fig25/plot.gp,energy-g0.5 $(fig25)/loops.csv,$(fig25)/loops.csv))
$(eval $(call plot_rule,$(fig25)/exponential,studies/fig25/plot.gp,g0.5 $(fig25)/loops.csv,$(fig25)/loops.csv))
$(eval $(call plot_rule,$(fig25)/no-cohesion,studies/fig25/plot.gp,g0 $(fig25)/loops.csv,$(fig25)/loops.csv))
$(eval $(call judge_rule,fig25,,$(fig25)/cycles.csv))

fig26_files := $(addprefix $(fig26)/,$(call both_formats,damage plastic) verdict.json)
fig26: $(fig26_files)
$(foreach p,damage plastic,$(eval $(call plot_rule,$(fig26)/$(p),studies/fig26/plot.gp,$(p) $(fig25)/cycles.csv,$(fig25)/cycles.csv | $(fig26))))
$(eval $(call judge_rule,fig26,,$(fig25)/cycles.csv))
$(fig26)/verdict.json: | $(fig26)
