# cmake -DROOT=project -DSOURCE=out -P CourseFiles.cmake: writes a source with the files of a student's folder. It has
# the kernels that --shader-dir needs, with the start of the course as pathtrace.comp, and what they include.
cmake_minimum_required(VERSION 3.22)
set(queue coursework/start.comp fold.comp add.comp resolve.comp estimate.comp accuracy.comp first_hit.comp)
set(files)
while(queue)
  list(POP_FRONT queue name)
  if(name IN_LIST files OR NOT EXISTS ${ROOT}/shaders/${name})
    continue()
  endif()
  list(APPEND files ${name})
  file(STRINGS ${ROOT}/shaders/${name} includes REGEX "^#include \"")
  foreach(line IN LISTS includes)
    string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" included "${line}")
    list(APPEND queue ${included})
  endforeach()
endwhile()
list(TRANSFORM files PREPEND shaders/)
file(GLOB scenes RELATIVE ${ROOT} ${ROOT}/cli/scenes/coursework*.json)

set(rows)
foreach(path IN LISTS files scenes)
  file(READ ${ROOT}/${path} text)
  string(REGEX REPLACE "^shaders/(coursework/)?|^cli/" "" name ${path})
  string(REPLACE "start.comp" "pathtrace.comp" name ${name})
  string(APPEND rows "        {\"${name}\", R\"pt~(${text})pt~\"},\n")
endforeach()
file(WRITE ${SOURCE} "#include \"cli/course/course_files.h\"

namespace cli {

const std::vector<CourseFile> &course_files() {
    static const std::vector<CourseFile> files{
${rows}    };
    return files;
}

} // namespace cli
")
