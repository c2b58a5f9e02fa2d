# Most of the time of a sanitized test run goes into these, which compare the bytes of whole runs, and of large inputs. The
# code that they run is also run by smaller tests; they themselves run in the optimized build alone.
set(long_tests
  SweepDepth.Rows* SweepDepth.Shared* SweepDepth.Axis* SweepDepth.Tiles* RefinePlanes.Tiles* FuseViews.Slabs*
  WorkGuard.* CoarseSweep.FindsTheWalls* CoarseSweep.FindsNothing* CoarseSweep.Follows* FindRangesInside.Gives*
  RenderTemple.Texture* *Conformance.TheCpu* RunExperiments.* RunMakerTest.RunsThat* RunMakerTest.Scenes*
  RunMakerTest.Broken* RunMakerTest.ARun* RunMakerTest.Measures* FindExtent.Leaves* FindExtent.OfACamera*
  FindExtent.OfAStrip* OutsidePlanes.WhatLiesBeyond* HalfSize.WhatLiesBeyond* PlanOfWeakTexture.*
  RenderTemple.Lights* PointScene.Workspace* PointScene.CloudAnd* PointScene.MeshIs* PointScene.MovedFar*
  PointScene.AllFormats* PointScene.Bounds* CameraPath.OfA* CameraPath.With* CameraPath.Around*
  BackendsParity.ImagesOf* BackendsParity.DepthMapsAreEqual* FuseViewsParity.HolesAreFilledWhere*
  VoteDepthParity.Seeded* SweepDepth*Parity.Every* SweepDepth*Parity.TheSecond* Reconstruct.MeshIsNear*
  Bounds.* Reconstruct.Threads* Reconstruct.DepthThenFuse* Reconstruct.FillHoles* Reconstruct.OtherOptions*
  Reconstruct.Progress* Reconstruct.Vulkan* Reconstruct.ViewsWithout* Reconstruct.SceneWithout*
  Reconstruct.RenderByError* Plans.Sizes* Report.Names* Report.Where* ApiReconstruct.FilesAnd*
  ApiReconstruct.MasksOf* ApiReconstruct.TwoRuns* ApiReconstruct.AStopped* ApiPoints.NeighborsOf*
  Reconstruct.ABudget* Reconstruct.Sigterm* BadInput.CamerasOf* BadInput.MissingBounds* Endings.EachSignal*
  Endings.Messages* Endings.Results* Endings.TheFirst* Endings.Stacks* Resume.The* Resume.Another* Resume.After*
  Resume.Left* Resume.FuseRefusesMapsOfMixed* Resume.FuseTakes* Resume.No* Resume.ASecond* Shards.AnyOrder*
  Shards.MoreShards* Shards.WorkAt* Shards.Options* TextureCommand.AnyNumber* TextureCommand.Obj*
  TextureCommand.Reconstruct* WithoutVulkan.Results* ConvertWithDepth.*)
