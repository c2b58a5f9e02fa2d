// The cases. What they must give is docs/conformance.md, too; a change of these numbers is a change of results: raise
// the stage's version (engine/pipeline/stage_versions.h), and say why in the commit.
#include "engine/conformance/conformance.h"

namespace quorum {

const std::vector<ConformanceCase>& conformance_cases() {
  static const std::vector<ConformanceCase> kCases = {
      {.name = "defaults",
       .temple = {.views = 8, .width = 160},
       .options = "",
       .expected = {"35c9917772377e1bab42c239fc9a215b7420a66b935f5dd62faf79d39e31a43e",
                    "a4609111bd38e4730112f9e2e8c462a1c7ab861dcd92ba73d54f999aafa14176",
                    "b4fdb5b66d0ed1bcc069c7cdb11712416494961f3d7d9ba2b0b86147f8ae6554",
                    "8a013ddef5a3346faec19d5c639136919e30a86d4569bb85959079a97b8d0dfe"}},
      {.name = "paper",
       .temple = {.views = 8, .width = 160},
       .options = "--window-model plane --threshold 0.6 --depth-step 2.5mm --no-confirm --feather 4 "
                  "--signed-distance ray",
       .expected = {"35c9917772377e1bab42c239fc9a215b7420a66b935f5dd62faf79d39e31a43e",
                    "a4609111bd38e4730112f9e2e8c462a1c7ab861dcd92ba73d54f999aafa14176",
                    "4fa3c07020805cd1b3deece5018d3892e5b1d0dfa4ebdc2dae92de4d0d01ea6e",
                    "e982142cee0eb9ce4168d4b0028844e7a0a8f2e0192efc4e82181e25a6dc85ec"}},
      {.name = "axis",
       .temple = {.views = 8, .width = 160, .seed = 2},
       .options = "--window-model axis --window 7 --neighbors 3 --weights confidence,slant",
       .expected = {"7809fe5a041340a0a31174553f5d6c7155314438c5da541b7d16428699aa4e7b",
                    "a4609111bd38e4730112f9e2e8c462a1c7ab861dcd92ba73d54f999aafa14176",
                    "82130e1010e28c561ac53050e2d1f7156dd8d54dbcf5e6a3fc3b640feed00ec9",
                    "29dcbfc7885a2f770e613b90a2b3b23ac2bd78a57f5b4347390c8579134d85cb"}},
      {.name = "holes",
       .temple = {.views = 9, .path = CameraPath::kHemisphere, .width = 144, .texture = 0.4},
       .options = "--second-window 9 --fill-holes --mask-below 0.02",
       .expected = {"44d0dfd42ee7b437bc6359b25cddbedc5c59a08106fb74a050e4a1fd22bc61d9",
                    "b3ac74f2d3c98f54a0951a84278752018045304ebff738983e219df7b06bcbeb",
                    "a216c3825e89d69e7a3cea1d2c1058cb3fc2aeeb74716da3c651e009349328e8",
                    "10b246a48ee6f000e4c38b3dd40aa8c34fe1b726088b1ffc3f74b6fdd22635c7"}},
      {.name = "large windows",
       .temple = {.views = 8, .width = 128, .gloss = 0.5, .lighting = Lighting::kPerView},
       .options = "--window 15 --window-model plane --refinement 4 --min-votes 3 --neighbors 5",
       .expected = {"094931313f19cee06a5317b6d35470c0850ff6534954a5a1607380fda2cdf935",
                    "f8e7c85bbbd60c93939fd06945bbe9cc59c46debf99b63c49e82114a93b07a2a",
                    "e80a4c9347aa68eb53e93587dc75e434e483b0e23bb9affd3b9bbb6feccd3667",
                    "bb7408489713466b95cb8c445108fcfc60027bbfbed9862e5d83eb9be558957a"}},
      {.name = "full size",
       .temple = {.views = 24, .width = 640},
       .options = "",
       .expected = {"d0509b6c3b86fc815ca4ab05a04a43caf8c0ebdbc9996611ad17d6051fe04403",
                    "6ba84a06dd4e5448c183543f8ddbb36f23c708db4d8c7108dd66cddc3d1c02d7",
                    "68e89418bb018b0c6964279aaef8f75891ff27bff26e8966d06771ee90c1fd24",
                    "43c3ddae320b6e335bbebdd705b6d7337d75aa34cb94bb3a2081adfe6ad0aedc"},
       .quick = false},
  };
  return kCases;
}

}  // namespace quorum
