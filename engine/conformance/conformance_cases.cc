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
                    "e5764d4c2956ce1668a8906421b6ee3fab0a43ad0d6c866f816d012a5f2f23f5",
                    "b4fdb5b66d0ed1bcc069c7cdb11712416494961f3d7d9ba2b0b86147f8ae6554",
                    "8a013ddef5a3346faec19d5c639136919e30a86d4569bb85959079a97b8d0dfe"}},
      {.name = "paper",
       .temple = {.views = 8, .width = 160},
       .options = "--window-model plane --threshold 0.6 --depth-step 2.5mm --no-confirm --feather 4 "
                  "--signed-distance ray",
       .expected = {"35c9917772377e1bab42c239fc9a215b7420a66b935f5dd62faf79d39e31a43e",
                    "e5764d4c2956ce1668a8906421b6ee3fab0a43ad0d6c866f816d012a5f2f23f5",
                    "8cb2c145c59ae9b3c176ee2c37368f80c4d2f8db1bf2654f8b1dcfa47054d621",
                    "e982142cee0eb9ce4168d4b0028844e7a0a8f2e0192efc4e82181e25a6dc85ec"}},
      {.name = "axis",
       .temple = {.views = 8, .width = 160, .seed = 2},
       .options = "--window-model axis --window 7 --neighbors 3 --weights confidence,slant",
       .expected = {"7809fe5a041340a0a31174553f5d6c7155314438c5da541b7d16428699aa4e7b",
                    "e5764d4c2956ce1668a8906421b6ee3fab0a43ad0d6c866f816d012a5f2f23f5",
                    "3a2efc5a1b02172642cea72d94aee49fd437f05154d7ea0d9bba62656c59de50",
                    "29dcbfc7885a2f770e613b90a2b3b23ac2bd78a57f5b4347390c8579134d85cb"}},
      {.name = "holes",
       .temple = {.views = 9, .path = CameraPath::kHemisphere, .width = 144, .texture = 0.4},
       .options = "--second-window 9 --fill-holes --mask-below 0.02",
       .expected = {"44d0dfd42ee7b437bc6359b25cddbedc5c59a08106fb74a050e4a1fd22bc61d9",
                    "18500c4b5bb4a90a17ddc98b86c76fd7245a1a3bfa35b2af9e9e5da00015b9b0",
                    "a216c3825e89d69e7a3cea1d2c1058cb3fc2aeeb74716da3c651e009349328e8",
                    "10b246a48ee6f000e4c38b3dd40aa8c34fe1b726088b1ffc3f74b6fdd22635c7"}},
      {.name = "large windows",
       .temple = {.views = 8, .width = 128, .gloss = 0.5, .lighting = Lighting::kPerView},
       .options = "--window 15 --window-model plane --refinement 4 --min-votes 3 --neighbors 5",
       .expected = {"094931313f19cee06a5317b6d35470c0850ff6534954a5a1607380fda2cdf935",
                    "642ba7bb77e1cc4b9f6761799a8f2bec1fa0f5318a1270408373df794f695500",
                    "3b5dec5f05d0c9312e230198f1d1f71cdffa37308b841cdf4c0cb5c9991bba3f",
                    "bb7408489713466b95cb8c445108fcfc60027bbfbed9862e5d83eb9be558957a"}},
      {.name = "full size",
       .temple = {.views = 24, .width = 640},
       .options = "",
       .expected = {"d0509b6c3b86fc815ca4ab05a04a43caf8c0ebdbc9996611ad17d6051fe04403",
                    "19f8b999210f7288f06ce727c9ad15a0413b1ff032b03427a19101f1b4a7d7c3",
                    "c587b91476974c4219fddcae5b6441998e52841a606c7da3cc1db71fa157637f",
                    "43c3ddae320b6e335bbebdd705b6d7337d75aa34cb94bb3a2081adfe6ad0aedc"},
       .quick = false},
  };
  return kCases;
}

}  // namespace quorum
