# cmake -DINPUT=FILE -DOUTPUT=FILE.cpp -DHEADER=header.h -DNAMESPACE=a::b -DNAME=kName -P embed.cmake
# Writes a source file that defines `const std::string_view NAME`, declared in HEADER, with the bytes of INPUT.
file(READ "${INPUT}" bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" text "${bytes}")
file(SIZE "${INPUT}" size)
file(WRITE "${OUTPUT}" "#include \"${HEADER}\"

namespace ${NAMESPACE} {

const std::string_view ${NAME}(\"${text}\", ${size});

}  // namespace ${NAMESPACE}
")
