# cmake -DOUT=FILE -DSOURCES=A:B:... -P JoinTests.cmake: several files of tests as one. Their names are their own and many
# are the same, so each unnamed namespace gets one inside that is named after its file.
string(REPLACE ":" ";" SOURCES "${SOURCES}")
set(joined "")
foreach(source IN LISTS SOURCES)
  get_filename_component(name ${source} NAME_WE)
  file(READ ${source} text)
  string(REPLACE "\nnamespace {\n" "\nnamespace { namespace ${name}_file {\n" text "${text}")
  string(REPLACE "\n}  // namespace\n" "\n}}  // namespace\n" text "${text}")
  string(APPEND joined "#line 1 \"${source}\"\n${text}")
endforeach()
file(WRITE ${OUT} "${joined}")
