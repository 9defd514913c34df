# Processor seconds of the tests that take long, of those that CMake finds in the programs: ctest starts the dearest first.
# What it measured itself in an earlier run goes before these.
set_tests_properties(PracticeRecordings.NoneIsNamed PracticeRecordings.GaussMarkovIsNamed
                     PracticeRecordings.ThermalHysteresisIsNamed PracticeRecordings.ScaleFactorIsNamed
                     Diagnosis.FindsNothingWhereThereIsNoGap SetSearch/StrongSet.IsFoundWhole/angle
                     ArimaLikelihood.RecoversItsParametersAndKnowsItsOwnErrors
                     Memory.DoesNotGrowWithTheNumberOfTrials
                     PROPERTIES COST 30)
set_tests_properties(Gap.ThePValueOfTheKnownSimulatorsOwnRecordingsIsUniform
                     Gap.ThePValueOfTheFittedSimulatorsOwnRecordingsIsUniform
                     Runner.AnyNumberOfLanesGivesTheSameBits Diagnosis.IsTheSameForAnyNumberOfThreads
                     RandomErrorCell.TheOracleIsNeverBeaten Diagnosis.TheHeldOutPartChangesNeitherFitNorChoice
                     SetSearch/StrongSet.IsFoundWhole/iron SetSearch/StrongSet.IsFoundWhole/averaged
                     SetSearch/StrongSet.IsFoundWhole/motion SetSearch.AScaleUnderAThermalLoopIsOneEffect
                     SetSearch.AResponseOfAnotherFormIsNoNoise SetSearch.IronBesideALagIsFoundInEitherForm
                     PROPERTIES COST 15)
set_tests_properties(Store.SurvivesALogThatAPowerCutHasTruncated
                     Store.SurvivesBeingKilledAtRandomMoments Shard.MergedShardsEqualTheSingleRunByteForByte
                     Run.CtrlCEndsWithTheTablesOfWhatIsDone Run.ATerminationEndsAsCtrlCDoes
                     Memory.TenThousandTrialsOfAMinuteStayUnder300MiB
                     PROPERTIES COST 8)
