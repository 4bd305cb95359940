# awk -v tables=FOLDER -f page.awk page.md: the page, each line '@table NAME' replaced by FOLDER/NAME.md.
$1 == "@table" {
  file = tables "/" $2 ".md"
  lines = 0
  while ((getline line < file) > 0) { print line; ++lines }
  close(file)
  if (!lines) {
    print "page.awk: " file " is not there or empty" > "/dev/stderr"
    exit 1
  }
  next
}
{ print }
