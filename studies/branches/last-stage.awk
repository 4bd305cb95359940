# awk -f last-stage.awk PROGRAMME.toml: the name of its last stage.
/^\[\[stages\]\]/ { inside = 1 }
inside && /^name[ =]/ { split($0, part, "\""); name = part[2] }
END { print name }
