#include "tests/support/data_folder.h"

std::string data_folder() {
    return PT_TEST_DATA_DIR;
}
