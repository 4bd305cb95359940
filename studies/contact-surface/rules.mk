#: contact-surface  contact of grains in many orientations and with unequal meshes (twenty minutes; builds its program)
# contact-surface: what orientation, unequal meshes and facets do to contact forces and pressures. Included by
# Makefile.studies, whose conventions apply here. Its programs are not built by default; the rules below build them if
# BIN belongs to a build folder.

contact_surface := out/contact-surface
contact_surface_tables := rotations.csv unequal.csv pressure.csv packing.csv geometry.csv
contact_surface_pictures := rotations.png rotations.svg profile.png profile.svg
.PHONY: contact-surface
contact-surface: $(addprefix $(contact_surface)/,$(contact_surface_tables) $(contact_surface_pictures))

$(contact_surface)/work:
	mkdir -p $@

$(BIN)/contact-surface $(BIN)/nodal-pressure:
	cmake --build $(BIN)/.. --target $(@F)

$(eval $(call stamp,$(contact_surface)/work/settings,$(call content_of,studies/contact-surface/measure.sh)))

$(contact_surface)/work/done: studies/contact-surface/measure.sh $(contact_surface)/work/settings \
  | $(small_mesh) $(contact_surface)/work $(BIN)/contact-surface
	for file in $(@D)/*.csv; do [ $$file -nt $(@D)/settings ] || rm -f $$file; done
	$(RUN) sh $< $(BIN) $(small_mesh) $(@D)
	touch $@

$(contact_surface)/rotations.csv $(contact_surface)/unequal.csv: $(contact_surface)/%.csv: \
  studies/contact-surface/%.awk $(contact_surface)/work/done
	awk -f $< $(@D)/work/$*-*.csv > $@.partial
	mv $@.partial $@

$(contact_surface)/pressure.csv $(contact_surface)/packing.csv: $(contact_surface)/%.csv: $(contact_surface)/work/done
	awk 'FNR > 1 || NR == 1' $(@D)/work/$*-*.csv > $@.partial
	mv $@.partial $@

$(contact_surface)/geometry.csv: $(contact_surface)/work/done
	cp $(@D)/work/geometry.csv $@.partial
	mv $@.partial $@

$(contact_surface)/rotations.png $(contact_surface)/rotations.svg: $(contact_surface)/rotations.%: \
  studies/contact-surface/plot.gp studies/common/style.gp $(contact_surface)/rotations.csv
	$(gnuplot) -c $< $* $(contact_surface)/rotations.csv $@.partial
	mv $@.partial $@

$(contact_surface)/profile.png $(contact_surface)/profile.svg: $(contact_surface)/profile.%: \
  studies/contact-surface/plot-profile.gp studies/common/style.gp $(contact_surface)/work/done
	$(gnuplot) -c $< $* $(contact_surface)/work $@.partial
	mv $@.partial $@
