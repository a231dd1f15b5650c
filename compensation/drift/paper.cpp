#include "compensation/drift/paper.h"

namespace gyrocal {

const DriftTable& paper_table_1() {
  static const DriftTable table{
      {-10, -7, -5, -2, 0,  3,  5,  8,  10, 13, 15, 18, 20,
       23,  25, 28, 30, 33, 35, 38, 40, 43, 45, 48, 50},
      {4.3839, 4.3385, 4.3299, 4.3432, 4.3422, 4.3063, 4.2786, 4.1863, 4.2251,
       4.2074, 4.1455, 4.0979, 4.1039, 4.0913, 4.0717, 4.0666, 4.1113, 4.1327,
       4.0645, 4.0228, 4.0872, 4.0612, 4.0708, 4.0811, 4.0430}};
  return table;
}

}  // namespace gyrocal
