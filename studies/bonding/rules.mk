#: bonding          softening law, fracture energy and penalty against the strength of a small compact
bonding := $(out)/bonding
.PHONY: bonding
bonding: $(bonding)/strength.csv
$(eval $(call stamp,$(bonding)/work/settings,$(call content_of,studies/bonding/pulling.toml)))

$(bonding)/strength.csv: studies/bonding/sweep.sh studies/bonding/strength.awk $(bonding)/work/settings \
  | $(small_mesh) $(BIN)/mpfem $(BIN)/postproc
	for run in $(@D)/work/*.h5; do [ $$run -nt $(@D)/work/settings ] || rm -f $$run; done
	sh $< $(BIN) $(small_mesh) $(@D)/work $(RUN) > $@.partial
	mv $@.partial $@
