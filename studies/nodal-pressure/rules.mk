#: nodal-pressure   averaged pressure in vibration, cycles and strong flow (ten minutes; builds its program)
# nodal-pressure: is average nodal pressure free of weak modes? Included by Makefile.studies.

nodal_pressure := out/nodal-pressure
.PHONY: nodal-pressure
nodal-pressure: $(addprefix $(nodal_pressure)/,vibration.csv flattening.csv cycles.csv cycles.png cycles.svg)

$(nodal_pressure)/work:
	mkdir -p $@

$(eval $(call stamp,$(nodal_pressure)/work/settings,$(call content_of,studies/nodal-pressure/measure.sh)))

$(nodal_pressure)/work/done: studies/nodal-pressure/measure.sh $(nodal_pressure)/work/settings \
  | $(small_mesh) $(nodal_pressure)/work $(BIN)/nodal-pressure
	for file in $(@D)/*.csv; do [ $$file -nt $(@D)/settings ] || rm -f $$file; done
	$(RUN) sh $< $(BIN) $(small_mesh) $(@D)
	touch $@

$(nodal_pressure)/vibration.csv: studies/nodal-pressure/vibration.awk $(nodal_pressure)/work/done
	awk -f $< $(@D)/work/vibration-*.csv > $@.partial
	mv $@.partial $@

$(nodal_pressure)/flattening.csv $(nodal_pressure)/cycles.csv: $(nodal_pressure)/%.csv: $(nodal_pressure)/work/done
	awk 'FNR > 1 || NR == 1' $(@D)/work/$*-*.csv > $@.partial
	mv $@.partial $@

$(nodal_pressure)/cycles.png $(nodal_pressure)/cycles.svg: $(nodal_pressure)/cycles.%: \
  studies/nodal-pressure/plot.gp studies/common/style.gp $(nodal_pressure)/cycles.csv
	$(gnuplot) -c $< $* $(nodal_pressure)/cycles.csv $@.partial
	mv $@.partial $@
