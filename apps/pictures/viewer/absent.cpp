// SPDX-License-Identifier: Apache-2.0
// The viewer of a build without windows.
#include "base/error.h"
#include "viewer.h"

namespace luxo {

int runViewer(ViewedScene, const ViewerOptions&) {
  throw Error(ErrorKind::Usage, "this build of luxo has no window",
              "use -o FILE to render without one, or build with LUXO_WINDOW=ON");
}

}  // namespace luxo
