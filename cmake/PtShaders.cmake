# pt_embed_shader(TARGET SOURCE): compiles a compute shader to SPIR-V at build time, checks it with spirv-val, and gives
# TARGET a header <name>.spv.h whose function <name>_spirv() returns the words. Included files are tracked.
find_program(PT_GLSLANG NAMES glslang glslangValidator REQUIRED)
find_program(PT_SPIRV_VAL NAMES spirv-val REQUIRED)

function(pt_embed_shader target source)
  cmake_path(GET source STEM name)
  cmake_path(GET source PARENT_PATH directory)
  set(spirv ${CMAKE_CURRENT_BINARY_DIR}/shaders/${name}.spv)
  file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/shaders)
  add_custom_command(
    OUTPUT ${spirv}
    COMMAND ${PT_GLSLANG} --quiet -g0 -V --target-env vulkan1.2 -I${directory} -I${PROJECT_SOURCE_DIR}/shaders --depfile
            ${spirv}.d -o ${spirv} ${source}
    COMMAND ${PT_SPIRV_VAL} --target-env vulkan1.2 ${spirv}
    DEPENDS ${source}
    DEPFILE ${spirv}.d
    COMMENT "Compiling ${name}.comp"
    VERBATIM
  )
  add_custom_command(
    OUTPUT ${spirv}.h
    COMMAND ${CMAKE_COMMAND} -DSPIRV=${spirv} -DHEADER=${spirv}.h -DSYMBOL=${name}_spirv -P
            ${PROJECT_SOURCE_DIR}/cmake/SpirvToHeader.cmake
    DEPENDS ${spirv} ${PROJECT_SOURCE_DIR}/cmake/SpirvToHeader.cmake
    COMMENT "Embedding ${name}.spv"
    VERBATIM
  )
  target_sources(${target} PRIVATE ${spirv}.h)
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/shaders)
endfunction()
