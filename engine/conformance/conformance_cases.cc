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
                    "bc78da2497a032ec86a2590673737a2b0fceb01cb154ef66dbe1069e399e7388",
                    "86de1483b6b946d2231c0e00de3d330adcf8b500e467cacc3a673bc141ca9869"}},
      {.name = "paper",
       .temple = {.views = 8, .width = 160},
       .options = "--window-model plane --threshold 0.6 --depth-step 2.5mm --no-confirm --feather 4 "
                  "--signed-distance ray --max-slope 70 --plane-agreement 0",
       .expected = {"35c9917772377e1bab42c239fc9a215b7420a66b935f5dd62faf79d39e31a43e",
                    "a4609111bd38e4730112f9e2e8c462a1c7ab861dcd92ba73d54f999aafa14176",
                    "4fa3c07020805cd1b3deece5018d3892e5b1d0dfa4ebdc2dae92de4d0d01ea6e",
                    "e982142cee0eb9ce4168d4b0028844e7a0a8f2e0192efc4e82181e25a6dc85ec"}},
      {.name = "axis",
       .temple = {.views = 8, .width = 160, .seed = 2},
       .options = "--window-model axis --window 7 --neighbors 3 --weights confidence,slant",
       .expected = {"7809fe5a041340a0a31174553f5d6c7155314438c5da541b7d16428699aa4e7b",
                    "a4609111bd38e4730112f9e2e8c462a1c7ab861dcd92ba73d54f999aafa14176",
                    "625bd0b06288c771760a6af7481103699b677ef7332bf91cd15af3a5e8974306",
                    "74130f78be2b107daf30243f20a7968efbc90f0f21e79736fbed0fd0c403fff1"}},
      {.name = "holes",
       .temple = {.views = 9, .path = CameraPath::kHemisphere, .width = 144, .texture = 0.4},
       .options = "--second-window 9 --fill-holes --mask-below 0.02",
       .expected = {"44d0dfd42ee7b437bc6359b25cddbedc5c59a08106fb74a050e4a1fd22bc61d9",
                    "b3ac74f2d3c98f54a0951a84278752018045304ebff738983e219df7b06bcbeb",
                    "81a96c3cee320f472416aa3001865e5a34b5f522e2c251299be3bc0e30f045ea",
                    "572bb961134b01f87b84514e5b1ba8b91a47483b97cf51a0685443b39a2941af"}},
      {.name = "large windows",
       .temple = {.views = 8, .width = 128, .gloss = 0.5, .lighting = Lighting::kPerView},
       .options = "--window 15 --window-model plane --refinement 4 --min-votes 3 --neighbors 5",
       .expected = {"094931313f19cee06a5317b6d35470c0850ff6534954a5a1607380fda2cdf935",
                    "f8e7c85bbbd60c93939fd06945bbe9cc59c46debf99b63c49e82114a93b07a2a",
                    "b523bd3bf4a22639b14c38ad691fc50cade6d668517e1b8723939912204c28dc",
                    "b98f9fa8a7e201579c33943e988f0f1cc5a1df8f1fdfac8e53e85a14f28f7791"}},
      {.name = "full size",
       .temple = {.views = 24, .width = 640},
       .options = "",
       .expected = {"d0509b6c3b86fc815ca4ab05a04a43caf8c0ebdbc9996611ad17d6051fe04403",
                    "6ba84a06dd4e5448c183543f8ddbb36f23c708db4d8c7108dd66cddc3d1c02d7",
                    "18f610383bb434727e45d81fb850f4622d30959e2de28da95850f6e5d8aa408f",
                    "b94bdbc930306b74dfcd8c4a92e808276ddece273f79452f95a3f902a0100f8c"},
       .quick = false},
  };
  return kCases;
}

}  // namespace quorum
