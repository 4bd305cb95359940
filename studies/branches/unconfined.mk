# fig10 to fig16: unloading and unconfined compression. Included by Makefile.studies after rules.mk.

branch_figures += fig10 fig11 fig12 fig13 fig14 fig15 fig16
.PHONY: fig10 fig11 fig12 fig13 fig14 fig15 fig16
$(foreach f,10 11 12 13 14 15 16,$(eval fig$(f) := $(out)/fig$(f)))
$(foreach f,10 11 12 13 14 15 16,$(out)/fig$(f)):
	mkdir -p $@

# $(call picture_rules,FIGURE,PICTURE,DATA): OUT/PICTURE.png and .svg by studies/FIGURE/plot.gp, which is given the picture's name.
define picture_rules
$($(1))/$(2).png $($(1))/$(2).svg: $($(1))/$(2).%: studies/$(1)/plot.gp studies/common/style.gp $(3) $(call spread_of,$(1))
	$(gnuplot) $(call spread_option,$(1)) -c $$< $$* $(2) $$(@D) $$@.partial
	mv $$@.partial $$@
endef
# $(call verdict_rule,FIGURE,DATA,ASSIGNMENTS)
define verdict_rule
$($(1))/verdict.json: studies/common/verdict.awk studies/branches/fits.awk studies/$(1)/verdict.awk $(2)
	awk -f studies/common/verdict.awk -f studies/branches/fits.awk -f studies/$(1)/verdict.awk -v mesh=$(MESH) $(3) $(2) > $$@.partial
	mv $$@.partial $$@
endef
# $(call fits_rule,FIGURE,LISTS): all fits of a figure in one list.
define fits_rule
$($(1))/fits.json: studies/branches/join-fits.sh $(2)
	sh $$^ > $$@.partial
	mv $$@.partial $$@
endef

recovery_columns := relative_density_max~[1]=unloading/elastic-recovery.relative_density_max \
  recovery~[1]=unloading/elastic-recovery.recovery_at_zero_stress uncertainty~[1]=unloading/elastic-recovery.uncertainty \
  recovery_at_residual~[1]=unloading/elastic-recovery.value residual_mean_stress~[MPa]=unloading/elastic-recovery.residual_mean_stress_MPa \
  mean_stress_at_max~[MPa]=unloading/elastic-recovery.mean_stress_at_max_MPa relative_density_min~[1]=unloading/elastic-recovery.relative_density_min
modulus_columns := modulus~[MPa]=unconfined/modulus.value modulus_uncertainty~[MPa]=unconfined/modulus.uncertainty \
  modulus_over_grains~[1]=unconfined/modulus.modulus_over_grains damage_over_work~[1]=unconfined/modulus.damage_over_axial_work \
  relative_density~[1]=unconfined/modulus.relative_density_at_start
strength_columns := strength~[MPa]=unconfined/strength.value strength_uncertainty~[MPa]=unconfined/strength.uncertainty \
  strain_at_peak~[1]=unconfined/strength.axial_strain_at_peak fall_after_peak~[1]=unconfined/strength.fall_after_peak \
  onset_stress~[MPa]=unconfined/strength.damage_onset_stress_MPa onset_strain~[1]=unconfined/strength.damage_onset_strain
contact_columns := contact_area_max~[1]=unloading/contact.contact_area_ratio_at_start contact_area~[1]=unconfined/contact.contact_area_ratio_at_start \
  bonded_area~[1]=unconfined/contact.bonded_area_ratio_at_start mean_damage~[1]=unconfined/contact.mean_damage_at_start \
  mean_damage_at_end~[1]=unconfined/contact.mean_damage_at_end damage_dissipation~[mJ]=unconfined/contact.damage_dissipation_at_start \
  damage_dissipation_at_end~[mJ]=unconfined/contact.damage_dissipation_at_end
density_max_column := relative_density_max~[1]=unloading/elastic-recovery.relative_density_max

# ------------------------------------------------------------------------------------------------ fig10: elastic recovery
densities := 0.70 0.73 0.77 0.80 0.83 0.86 0.88 0.90 0.92
by_density := $(densities:%=g0.5-D%)
# The same with the other reading of the softening law, which leaves bonds all but undamaged by unloading.
by_density_energy_law := $(densities:%=energy-g0.5-D%)
by_modulus := $(addsuffix -D0.92,e3 e4 g0.5 e6 e7 e8)

fig10_files := $(addprefix $(fig10)/,recovery-density.png recovery-density.svg recovery-modulus.png recovery-modulus.svg fits.json verdict.json)
fig10: $(fig10_files)
$(eval $(call branch_table,$(fig10)/density.csv,$(by_density),$(recovery_columns)))
$(eval $(call branch_table,$(fig10)/density-energy-law.csv,$(by_density_energy_law),$(recovery_columns)))
$(eval $(call fit_rule,recovery,$(fig10)/density-energy-law.csv,relative_density_max,recovery,linear$(comma)bilinear))
$(eval $(call branch_table,$(fig10)/modulus.csv,$(by_modulus),$(recovery_columns)))
$(eval $(call fit_rule,recovery,$(fig10)/density.csv,relative_density_max,recovery,linear$(comma)bilinear))
$(eval $(call fit_rule,recovery,$(fig10)/modulus.csv,youngs_modulus,recovery,log-log))
fig10_density_tables := $(fig10)/density.csv $(fig10)/density-energy-law.csv
$(eval $(call fits_rule,fig10,$(fig10_density_tables:.csv=.recovery.fits.json) $(fig10)/modulus.recovery.fits.json))
$(eval $(call picture_rules,fig10,recovery-density,$(fig10_density_tables) $(fig10_density_tables:.csv=.recovery.fits.json)))
$(eval $(call picture_rules,fig10,recovery-modulus,$(fig10)/modulus.csv $(fig10)/modulus.recovery.fits.json))
$(eval $(call branch_quality,$(fig10),$(by_density:%=%-unloading) $(by_density_energy_law:%=%-unloading) $(by_modulus:%=%-unloading)))
$(eval $(call verdict_rule,fig10,$(fig10_density_tables) $(fig10)/modulus.csv $(fig10)/fits.json $(fig10)/quality.csv))

# ------------------------------------------------------------------------------------------------ fig11: elastic energy
energy_columns := loaded~[mJ]=unloading/energy.elastic_energy_loaded_mJ locked_in~[mJ]=unloading/energy.elastic_energy_locked_in_mJ \
  released~[mJ]=unloading/energy.elastic_energy_released_mJ damage~[mJ]=unloading/energy.damage_dissipation_mJ \
  damage_in_unloading~[mJ]=unloading/energy.damage_dissipation_in_unloading_mJ plastic~[mJ]=unloading/energy.plastic_dissipation_mJ \
  scale~[mJ]=unloading/energy.energy_scale_mJ loaded_over_scale~[1]=unloading/energy.elastic_energy_loaded_over_scale \
  locked_in_over_scale~[1]=unloading/energy.elastic_energy_locked_in_over_scale released_over_scale~[1]=unloading/energy.elastic_energy_released_over_scale \
  damage_over_scale~[1]=unloading/energy.damage_dissipation_over_scale \
  damage_in_unloading_over_scale~[1]=unloading/energy.damage_dissipation_in_unloading_over_scale \
  loaded_uncertainty~[mJ]=unloading/energy.elastic_energy_loaded_uncertainty_mJ \
  locked_in_uncertainty~[mJ]=unloading/energy.elastic_energy_locked_in_uncertainty_mJ \
  released_uncertainty~[mJ]=unloading/energy.elastic_energy_released_uncertainty_mJ \
  damage_in_unloading_uncertainty~[mJ]=unloading/energy.damage_dissipation_in_unloading_uncertainty_mJ
fig11_files := $(foreach p,normalised release energy,$(fig11)/$(p).png $(fig11)/$(p).svg) $(fig11)/verdict.json
fig11: $(fig11_files)
$(eval $(call branch_table,$(fig11)/release.csv,$(by_modulus),$(energy_columns)))
$(fig11)/curves.csv: studies/common/verdict.awk studies/fig11/curves.awk $(fig11)/release.csv $(foreach n,$(by_modulus),$(compactions)/$(n:-D0.92=)/curve.csv $(branches)/$(n)-unloading/curve.csv)
	awk -f $< -f $(filter-out $<,$^) > $@.partial
	mv $@.partial $@
$(foreach p,normalised energy,$(eval $(call picture_rules,fig11,$(p),$(fig11)/curves.csv)))
$(eval $(call picture_rules,fig11,release,$(fig11)/release.csv))
$(eval $(call verdict_rule,fig11,$(fig11)/release.csv $(fig11)/curves.csv))

# ------------------------------------------------------------------------------------------------ fig12: modulus and density
fig12_files := $(addprefix $(fig12)/,loading.png loading.svg modulus.png modulus.svg fits.json verdict.json)
fig12: $(fig12_files)
$(eval $(call branch_table,$(fig12)/modulus.csv,$(by_density),$(density_max_column) $(modulus_columns)))
$(eval $(call branch_table,$(fig12)/modulus-energy-law.csv,$(by_density_energy_law),$(density_max_column) $(modulus_columns)))
fig12_tables := $(fig12)/modulus.csv $(fig12)/modulus-energy-law.csv
$(foreach t,$(fig12_tables),$(eval $(call fit_rule,spriggs,$(t),relative_density_max,modulus_over_grains,spriggs,--relative-density)))
$(eval $(call fits_rule,fig12,$(fig12_tables:.csv=.spriggs.fits.json)))
# Three stages on one axial stress over axial strain curve.
$(fig12)/loading.csv: studies/common/verdict.awk studies/fig12/loading.awk $(compactions)/g0.5/curve.csv $(branches)/g0.5-D0.92-unloading/curve.csv $(branches)/g0.5-D0.92-unconfined/curve.csv | $(fig12)
	awk -f $< -f $(filter-out $<,$^) > $@.partial
	mv $@.partial $@
$(eval $(call picture_rules,fig12,loading,$(fig12)/loading.csv))
$(eval $(call picture_rules,fig12,modulus,$(fig12_tables) $(fig12_tables:.csv=.spriggs.fits.json)))
$(eval $(call branch_quality,$(fig12),$(by_density:%=%-unconfined) $(by_density_energy_law:%=%-unconfined)))
$(eval $(call verdict_rule,fig12,$(fig12_tables) $(fig12)/fits.json $(fig12)/quality.csv))

# ------------------------------------------------------------------------------------------------ fig13: strength and density
by_strength := $(addprefix g0.3-D,0.62 0.63 0.65 0.67 0.70 0.73 0.77)
# The same with the other reading of the softening law, on which strengths and the look of damage depend most.
by_strength_energy_law := $(addprefix energy-g0.3-D,0.63 0.67 0.73 0.77)
fig13_files := $(addprefix $(fig13)/,strength-density.png strength-density.svg strength-area.png strength-area.svg fits.json verdict.json)
fig13: $(fig13_files)
$(eval $(call branch_table,$(fig13)/strength.csv,$(by_strength),$(density_max_column) $(strength_columns) $(contact_columns)))
$(eval $(call branch_table,$(fig13)/strength-energy-law.csv,$(by_strength_energy_law),$(density_max_column) $(strength_columns) $(contact_columns)))
fig13_tables := $(fig13)/strength.csv $(fig13)/strength-energy-law.csv
$(foreach t,$(fig13_tables),$(eval $(call fit_rule,density,$(t),relative_density_max,strength,ryshkewitch-duckworth$(comma)rumpf,--relative-density)))
$(foreach t,$(fig13_tables),$(eval $(call fit_rule,area,$(t),contact_area_max,strength,log-log)))
$(eval $(call fits_rule,fig13,$(fig13_tables:.csv=.density.fits.json) $(fig13_tables:.csv=.area.fits.json)))
$(eval $(call picture_rules,fig13,strength-density,$(fig13_tables) $(fig13_tables:.csv=.density.fits.json)))
$(eval $(call picture_rules,fig13,strength-area,$(fig13_tables) $(fig13_tables:.csv=.area.fits.json)))
$(eval $(call branch_quality,$(fig13),$(by_strength:%=%-unconfined) $(by_strength_energy_law:%=%-unconfined)))
$(eval $(call verdict_rule,fig13,$(fig13_tables) $(fig13)/fits.json $(fig13)/quality.csv))

# ------------------------------------------------------------------------------------------------ fig14: damage at failure
fig14_samples := $(foreach l,g0.3 energy-g0.3,$(addprefix $(l)-D,0.73 0.67 0.63))
fig14_files := $(fig14_samples:%=$(fig14)/damage-%.png) $(fig14_samples:%=$(fig14)/damage-%.svg) $(fig14)/verdict.json
fig14: $(fig14_files)
fig14_section := --axis x --position 0.5 --relative --field damage
# With the law exponential every bond is damaged nearly all the way before the test, with energy hardly any.
fig14_range = $(if $(filter energy-%,$(1)),0$(comma)0.1,0.99$(comma)1)
$(fig14)/damage-%.png: $(branches)/%-unconfined/run.h5 | $(fig14) $(BIN)/postproc
	$(BIN)/postproc section $< --snapshot -1 $(fig14_section) --range $(call fig14_range,$*) --title "$$(echo $* | sed 's/^energy-g0.3-D/Law energy, D_max = /; s/^g0.3-D/Law exponential, D_max = /')" -o $(@D)/new-damage-$*.png
	mv $(@D)/new-damage-$*.png $@
# Of the same plane before the reloading (snapshot 0: after the rest) and at its end.
$(fig14)/before-%.csv: $(branches)/%-unconfined/run.h5 | $(fig14) $(BIN)/postproc
	$(BIN)/postproc section $< --snapshot 0 $(fig14_section) --data $(@D)/new-before-$*.csv
	mv $(@D)/new-before-$*.csv $@
$(fig14)/damage-%.csv: $(branches)/%-unconfined/run.h5 | $(fig14) $(BIN)/postproc
	$(BIN)/postproc section $< --snapshot -1 $(fig14_section) --data $(@D)/new-damage-$*.csv
	mv $(@D)/new-damage-$*.csv $@
$(eval $(call branch_table,$(fig14)/contacts.csv,$(fig14_samples),$(density_max_column) $(strength_columns) $(contact_columns)))
$(eval $(call verdict_rule,fig14,$(fig14)/contacts.csv $(fig14_samples:%=$(fig14)/before-%.csv) $(fig14_samples:%=$(fig14)/damage-%.csv)))

# ------------------------------------------------------------------------------------------------ fig15, fig16: fracture energy
by_energy := $(addsuffix -D0.77,g0.05 g0.1 g0.2 g0.3 g0.4 g0.5)
# With the other softening law bonds bear so much that the trends lie at smaller energies.
by_energy_energy_law := $(addsuffix -D0.77,$(addprefix energy-,g0.01 g0.02 g0.05 g0.1 g0.2 g0.3 g0.5))
by_energy_dense := $(addsuffix -D0.92,$(addprefix energy-,g0.01 g0.02 g0.05 g0.1 g0.5))
fig15_files := $(foreach p,force-displacement force-displacement-energy-law,$(fig15)/$(p).png $(fig15)/$(p).svg) $(fig15)/verdict.json
fig15: $(fig15_files)
# $(call fig15_rules,SUFFIX,NAMES)
define fig15_rules
$(call branch_table,$(fig15)/strength$(1).csv,$(2),$(density_max_column) $(strength_columns) $(contact_columns))
$(fig15)/force-displacement$(1).csv: studies/fig15/force-displacement.awk $(foreach n,$(2),$(branches)/$(n)-unconfined/curve.csv) | $(fig15)
	awk -f $$^ > $$@.partial
	mv $$@.partial $$@
$(call picture_rules,fig15,force-displacement$(1),$(fig15)/force-displacement$(1).csv)
endef
$(eval $(call fig15_rules,,$(by_energy)))
$(eval $(call fig15_rules,-energy-law,$(by_energy_energy_law)))
$(eval $(call branch_quality,$(fig15),$(by_energy:%=%-unconfined) $(by_energy_energy_law:%=%-unconfined)))
$(eval $(call verdict_rule,fig15,$(fig15)/strength.csv $(fig15)/strength-energy-law.csv $(fig15)/quality.csv))

fig16_files := $(addprefix $(fig16)/,modulus.png modulus.svg strength.png strength.svg fits.json verdict.json)
fig16: $(fig16_files)
fig16_tables := $(fig16)/energy.csv $(fig16)/energy-energy-law.csv
fig16_dense := $(fig16)/energy-energy-law-dense.csv
$(eval $(call branch_table,$(fig16)/energy.csv,$(by_energy),$(density_max_column) $(modulus_columns) $(strength_columns)))
$(eval $(call branch_table,$(fig16)/energy-energy-law.csv,$(by_energy_energy_law),$(density_max_column) $(modulus_columns) $(strength_columns)))
$(eval $(call branch_table,$(fig16_dense),$(by_energy_dense),$(density_max_column) $(modulus_columns)))
$(foreach t,$(fig16_tables) $(fig16_dense),$(eval $(call fit_rule,modulus,$(t),fracture_energy,modulus,inverse-exponential)))
$(foreach t,$(fig16_tables),$(eval $(call fit_rule,strength,$(t),fracture_energy,strength,exponential$(comma)inverse-exponential)))
$(eval $(call fits_rule,fig16,$(fig16_tables:.csv=.modulus.fits.json) $(fig16_dense:.csv=.modulus.fits.json) $(fig16_tables:.csv=.strength.fits.json)))
$(eval $(call picture_rules,fig16,modulus,$(fig16_tables) $(fig16_dense) $(fig16_tables:.csv=.modulus.fits.json) $(fig16_dense:.csv=.modulus.fits.json)))
$(eval $(call picture_rules,fig16,strength,$(fig16_tables) $(fig16_tables:.csv=.strength.fits.json)))
$(eval $(call verdict_rule,fig16,$(fig16_tables) $(fig16_dense) $(fig16)/fits.json))
