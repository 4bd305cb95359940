#: animation        a film of compaction, unloading and failure: out/MESH/animation/film.mp4, film.webp; needs
#:                  ./bootstrap animation, which installs VTK and ffmpeg
animation := $(out)/animation
film_width ?= 900
.PHONY: animation
animation: $(animation)/film.mp4 $(animation)/film.webp
	@echo 'animation: $^'
$(eval $(call stamp,$(animation)/work/settings,$(call content_of,studies/animation/film.toml) $(ELEMENT) $(SURFACE)))

$(animation)/run.h5: studies/animation/film.toml $(animation)/work/settings $(mesh) | $(BIN)/mpfem
	[ $(@D)/work/run.checkpoint.h5 -nt $(@D)/work/settings ] || rm -f $(@D)/work/run.*
	$(RUN) $(BIN)/mpfem run $< -o $(@D)/work/run.h5 --set packing=$(mesh) --set element.type=$(ELEMENT) \
	  --set contact.surface=$(SURFACE) --resume $(threads) > $(@D)/work/log.txt 2>&1 || \
	  { code=$$?; tail -n 3 $(@D)/work/log.txt >&2; [ $$code != 5 ] || $(same_command_again); exit $$code; }
	mv $(@D)/work/run.h5 $@

# One colour scale, up to the largest strain. Frames of an earlier film are removed.
$(animation)/frames.made: $(animation)/run.h5 | $(BIN)/postproc
	rm -rf $(@D)/frames
	$(RUN) $(BIN)/postproc picture $< --frames $(@D)/frames --color plastic-strain --size 1200x1000 --quiet
	touch $@

# Six frames a second, the last one for two seconds.
ffmpeg = ffmpeg -nostdin -loglevel error -y -framerate 6 -i $(@D)/frames/%04d.png
hold_last = tpad=stop_mode=clone:stop_duration=2
$(animation)/film.mp4: $(animation)/frames.made
	$(ffmpeg) -vf '$(hold_last)' -r 24 -c:v libx264 -crf 20 -pix_fmt yuv420p $(@D)/new-film.mp4
	mv $(@D)/new-film.mp4 $@

$(animation)/film.webp: $(animation)/frames.made
	$(ffmpeg) -vf '$(hold_last),scale=$(film_width):-2:flags=lanczos' -r 6 -c:v libwebp_anim -quality 70 -loop 0 \
	  $(@D)/new-film.webp
	mv $(@D)/new-film.webp $@
